// A small leaf that moves in a known way: what the tests of the output room write.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "support/meshes.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt::test {

inline constexpr int kColumns = 6, kRows = 8;

/// A skin with a seam along the middle column: its vertices stand twice, with other texture coordinates.
inline Skin seamed_skin(const SurfaceMesh& mesh, const Points3& positions) {
  Skin skin;
  for (const VertexId v : mesh.vertices()) skin.vertex.push_back(v);
  std::vector<int> right_twin(static_cast<std::size_t>(mesh.num_vertices()), -1);
  for (const VertexId v : mesh.vertices()) {
    if (std::abs(positions(int(v), 0)) > 1e-12) continue;
    right_twin[static_cast<std::size_t>(int(v))] = static_cast<int>(skin.vertex.size());
    skin.vertex.push_back(v);
  }
  skin.uv.resize(static_cast<int>(skin.vertex.size()), 2);
  for (int s = 0; s < skin.uv.rows(); ++s) {
    const auto position = positions.row(skin.vertex[static_cast<std::size_t>(s)]);
    const bool right = position[0] > 1e-12 || s >= mesh.num_vertices();
    skin.uv.row(s) << (right ? 0.55 : 0.45) + 5.0 * position[0], 0.9 - 8.0 * position[1];
  }
  skin.faces = mesh.face_matrix();
  for (const FaceId f : mesh.faces()) {
    double sum = 0.0;
    for (const VertexId v : mesh.face_vertices(f)) sum += positions(int(v), 0);
    for (int c = 0; c < 3; ++c) {
      const int twin = right_twin[static_cast<std::size_t>(skin.faces(int(f), c))];
      if (sum > 0.0 && twin >= 0) skin.faces(int(f), c) = twin;
    }
  }
  return skin;
}

/// A rectangle of 6 cm x 10 cm, petiole in the middle of its lower side, a seam along the midrib, a stalk of
/// 4 cm.
inline Leaf sample_leaf() {
  Surface surface = bent(grid(kColumns, kRows, 0.06, 0.1),
                         [](const Vec3& p) { return Vec3(p.x() - 0.03, p.y(), 2.0 * p.y() * p.y()); });
  for (int v = 0; v < surface.positions.rows(); ++v) {
    if (v % (kColumns + 1) == kColumns / 2) surface.positions(v, 0) = 0.0;
  }
  Leaf leaf;
  leaf.name = "maple <& \xc3\xa9>";
  leaf.species = "maple";
  leaf.seed = 18446744073709551615U;
  leaf.mesh = surface.mesh;
  leaf.positions = surface.positions;
  leaf.petiole = VertexId(kColumns / 2);
  leaf.skin = seamed_skin(leaf.mesh, leaf.positions);
  leaf.stalk.centreline.resize(5, 3);
  for (int k = 0; k < 5; ++k) {
    leaf.stalk.centreline.row(k) << 0.0, -0.01 * k, 0.0;
    leaf.stalk.radii.push_back(0.001 + 0.0002 * k);
  }
  leaf.notes = {"a note"};
  return leaf;
}

/// Neither the identity nor aligned with an axis.
inline Placement sample_placement() {
  Placement placement;
  placement.rotation = (Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized())).toRotationMatrix();
  placement.translation = Vec3(3.0, -1.0, 12.0);
  placement.scale = 100.0;
  return placement;
}

/// Iterations 0, 10, 30, 60, 100: the blade rolls up and the stalk droops.
inline std::vector<Frame> sample_frames(const Leaf& leaf) {
  std::vector<Frame> frames;
  for (const int iteration : {0, 10, 30, 60, 100}) {
    const double t = iteration / 100.0;
    Frame frame;
    frame.iteration = iteration;
    frame.positions = leaf.positions;
    frame.water_fraction.resize(leaf.mesh.num_vertices());
    for (const VertexId v : leaf.mesh.vertices()) {
      const Vec3 p = leaf.positions.row(v);
      frame.positions.row(v) << p.x() * (1.0 - 0.3 * t), p.y() * (1.0 - 0.1 * t),
          p.z() + t * 0.02 * std::sin(90.0 * p.x() + 40.0 * p.y());
      frame.water_fraction[v] = 0.8 - 0.5 * t * p.y() / 0.1;
    }
    frame.dryness = Eigen::VectorXd::Constant(leaf.mesh.num_vertices(), t);
    frame.stalk = leaf.stalk.centreline;
    for (int k = 0; k < frame.stalk.rows(); ++k)
      frame.stalk.row(k) += Vec3(0.0005 * t * k * k, 0.001 * t * k * k, -0.002 * t * k * k).transpose();
    frames.push_back(frame);
  }
  return frames;
}

/// Colours from green to brown, different at every vertex.
inline std::vector<Points3> sample_colours(const Leaf& leaf, const std::vector<Frame>& frames) {
  std::vector<Points3> colours;
  for (const Frame& frame : frames) {
    const double t = frame.iteration / 100.0;
    Points3 rows(leaf.mesh.num_vertices(), 3);
    for (const VertexId v : leaf.mesh.vertices())
      rows.row(v) << 0.28 + 0.3 * t, 0.4 + 0.1 * t, 0.02 + 0.3 * leaf.positions(int(v), 1);
    colours.push_back(rows);
  }
  return colours;
}

/// Two tips in the far corners, a primary vein to each, and a secondary vein.
inline Venation sample_venation(const Leaf& leaf) {
  const auto at_corner = [](int face, int corner) { return SurfacePoint{FaceId(face), Vec3::Unit(corner)}; };
  Venation venation;
  const int faces = leaf.mesh.num_faces();
  const SurfacePoint petiole = at_corner(kColumns, 0), middle{FaceId(faces / 2), Vec3(0.2, 0.3, 0.5)};
  venation.veins = {{1, 0, -1, {{petiole, middle, at_corner(faces - 2 * kColumns, 2)}, 0.11}},
                    {1, 1, -1, {{petiole, at_corner(faces - 1, 1)}, 0.12}},
                    {2, -1, 0, {{middle, at_corner(faces / 2 + 2, 1)}, 0.02}}};
  venation.tips = {{VertexId(kRows * (kColumns + 1)), 0.13, 0.11, 0.05},
                   {VertexId((kRows + 1) * (kColumns + 1) - 1), 0.19, 0.12, 0.04}};
  venation.margin.vertices = leaf.mesh.boundary_loops().front();
  const int count = static_cast<int>(venation.margin.vertices.size());
  venation.margin.s = Eigen::VectorXd::LinSpaced(count, 0.0, 0.3);
  venation.margin.d = Eigen::VectorXd::LinSpaced(count, 0.0, 0.1);
  return venation;
}

/// All of it, and a clip that refers to it.
struct Sample {
  Leaf leaf = sample_leaf();
  std::vector<Frame> frames = sample_frames(leaf);
  Venation venation = sample_venation(leaf);
  std::vector<Vec3> stalk_colours = std::vector<Vec3>(frames.size(), Vec3(0.5, 0.4, 0.2));

  Clip clip() const {
    return {leaf,
            frames,
            &venation,
            R"({"seed": 18446744073709551615, "iterations": 100, "a": {"dt": 0.01}})",
            sample_colours(leaf, frames),
            stalk_colours,
            ""};
  }
};

/// Leaves only the last row of the blade free to move: most differences from the rest are zero.
inline void hold_most(Sample& sample) {
  const int held = kRows * (kColumns + 1);
  for (Frame& frame : sample.frames) frame.positions.topRows(held) = sample.leaf.positions.topRows(held);
}

}  // namespace wilt::test
