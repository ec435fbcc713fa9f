// A lobed, bumpy, leaf-like surface for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "support/meshes.hpp"

namespace wilt::test {

struct LeafShape {
  int lobes = 5;
  double depth = 0.35;  ///< of the sinuses between the lobes, of the mean radius
  double bumps = 0.06;  ///< height of the bumps
  bool hole = false;    ///< leaves out the faces in a disc off the centre
  std::uint64_t seed = 1;
};

/// `rings` rings of triangles around a centre, the margin at radius 1 + depth cos(lobes t): 6 r vertices on
/// the r-th ring, moved sideways at random, lifted by smooth bumps. 3 rings (rings + 1) + 1 vertices.
inline Surface leaf(int rings, const LeafShape& shape = {}) {
  const auto first = [](int r) { return r == 0 ? 0 : 3 * r * (r - 1) + 1; };
  Random random(shape.seed, "leaf");
  Points3 positions(first(rings + 1), 3);
  for (int r = 0; r <= rings; ++r) {
    for (int i = 0; i < std::max(1, 6 * r); ++i) {
      const double jitter = r == rings ? 0.0 : 0.15 / rings;
      const double t = 2.0 * std::numbers::pi * i / std::max(1, 6 * r);
      const double s = static_cast<double>(r) / rings;
      const double radius = s * (1.0 + shape.depth * std::cos(shape.lobes * t));
      const double x = radius * std::cos(t) + random.uniform(-jitter, jitter);
      const double y = radius * std::sin(t) + random.uniform(-jitter, jitter);
      positions.row(first(r) + i) << x, y,
          shape.bumps * (std::sin(7.0 * x + 1.0) * std::cos(6.0 * y) + random.uniform(-1.0, 1.0) / rings);
    }
  }
  std::vector<Eigen::RowVector3i> faces;
  const auto add = [&](int a, int b, int c) {
    const Eigen::RowVector3d middle = (positions.row(a) + positions.row(b) + positions.row(c)) / 3.0;
    if (shape.hole && std::hypot(middle.x() - 0.3, middle.y() - 0.1) < 0.22) return;
    faces.emplace_back(a, b, c);
  };
  for (int r = 0; r < rings; ++r) {
    for (int side = 0; side < 6; ++side) {
      const auto inner = [&](int k) { return r == 0 ? 0 : first(r) + (side * r + k) % (6 * r); };
      const auto outer = [&](int k) { return first(r + 1) + (side * (r + 1) + k) % (6 * (r + 1)); };
      for (int k = 0; k <= r; ++k) add(inner(k), outer(k), outer(k + 1));
      for (int k = 0; k < r; ++k) add(inner(k), outer(k + 1), inner(k + 1));
    }
  }
  // Keep the vertices that some face uses.
  std::vector<int> index(positions.rows(), -1);
  int count = 0;
  Faces kept(faces.size(), 3);
  Points3 used(positions.rows(), 3);
  for (int f = 0; f < kept.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      int& i = index[faces[f][k]];
      if (i < 0) used.row(i = count++) = positions.row(faces[f][k]);
      kept(f, k) = i;
    }
  }
  return {SurfaceMesh(count, kept), used.topRows(count)};
}

}  // namespace wilt::test
