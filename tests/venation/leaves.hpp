// Leaves with known tips, for the tests of the veins.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "wilt/core/random.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt::test {

/// A flat blade about the origin with margin radius r(angle), the angle counter-clockwise from -y, where the
/// petiole is: `rings` rings of `sectors` vertices around a centre. The petiole is vertex 1 + sectors (rings
/// - 1).
inline Leaf polar_leaf(int rings, int sectors, const std::function<double(double)>& radius) {
  Points3 positions(1 + rings * sectors, 3);
  Faces faces(sectors * (2 * rings - 1), 3);
  positions.row(0).setZero();
  const auto at = [&](int ring, int sector) { return 1 + ring * sectors + (sector + sectors) % sectors; };
  int f = 0;
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < sectors; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sectors;
      const double r = radius(angle) * (ring + 1) / rings;
      positions.row(at(ring, k)) << r * std::sin(angle), -r * std::cos(angle), 0.0;
      if (ring == 0) {
        faces.row(f++) << 0, at(0, k), at(0, k + 1);
      } else if (ring % 2 == 0) {
        faces.row(f++) << at(ring - 1, k), at(ring, k), at(ring, k + 1);
        faces.row(f++) << at(ring - 1, k), at(ring, k + 1), at(ring - 1, k + 1);
      } else {
        faces.row(f++) << at(ring - 1, k), at(ring, k), at(ring - 1, k + 1);
        faces.row(f++) << at(ring, k), at(ring, k + 1), at(ring - 1, k + 1);
      }
    }
  }
  Leaf leaf;
  leaf.mesh = SurfaceMesh(static_cast<int>(positions.rows()), faces);
  leaf.positions = positions;
  leaf.petiole = VertexId(at(rings - 1, 0));
  return leaf;
}

/// `lobes` even lobes with tips at angles (k + 1/2) 2 pi / lobes and a deep sinus at the petiole.
inline Leaf star_leaf(int lobes, int rings = 10, int sectors = 70) {
  return polar_leaf(rings, sectors, [lobes](double angle) { return 0.06 - 0.04 * std::cos(lobes * angle); });
}

/// An ellipse, petiole at one end of its long axis of 0.2: convex, so that geodesics are straight.
inline Leaf ellipse_leaf(int rings = 8, int sectors = 48) {
  return polar_leaf(rings, sectors, [](double angle) {
    return 0.1 * 0.05 / std::hypot(0.05 * std::cos(angle), 0.1 * std::sin(angle));
  });
}

inline Leaf moved(Leaf leaf, const std::function<Vec3(const Vec3&)>& move) {
  for (int v = 0; v < leaf.positions.rows(); ++v)
    leaf.positions.row(v) = move(leaf.positions.row(v).transpose()).transpose();
  return leaf;
}

/// What a file makes of a leaf: positions rounded to float, vertices and faces in another order, another
/// name. `number` receives the new number of each vertex.
inline Leaf read_back(const Leaf& leaf, std::uint64_t seed, std::vector<int>* number) {
  Random random(seed, "read_back");
  const auto shuffled = [&](int count) {
    std::vector<int> order(count);
    for (int i = 0; i < count; ++i) order[i] = i;
    for (int i = count - 1; i > 0; --i) std::swap(order[i], order[random.index(i + 1)]);
    return order;
  };
  *number = shuffled(leaf.mesh.num_vertices());
  const std::vector<int> face_order = shuffled(leaf.mesh.num_faces());
  Leaf result = leaf;
  for (int v = 0; v < leaf.mesh.num_vertices(); ++v)
    result.positions.row((*number)[v]) = leaf.positions.row(v).cast<float>().cast<double>();
  Faces faces(leaf.mesh.num_faces(), 3);
  for (int f = 0; f < faces.rows(); ++f) {
    const int turn = random.index(3);
    for (int k = 0; k < 3; ++k)
      faces(face_order[f], k) = (*number)[leaf.mesh.face_matrix()(f, (k + turn) % 3)];
  }
  result.mesh = SurfaceMesh(leaf.mesh.num_vertices(), faces);
  result.petiole = VertexId((*number)[leaf.petiole]);
  result.name = result.species = "generic";
  return result;
}

}  // namespace wilt::test
