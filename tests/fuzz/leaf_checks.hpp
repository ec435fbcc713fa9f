// What holds for every leaf that an import returns.
#pragma once

#include <cmath>

#include "fuzz/contract.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::fuzz {

inline void check_skin(const Leaf& leaf) {
  const auto vertices = static_cast<Eigen::Index>(leaf.skin.vertex.size());
  require(leaf.skin.uv.rows() == vertices && leaf.skin.uv.allFinite(), "finite texture coordinates");
  require(leaf.skin.faces.rows() == leaf.mesh.num_faces(), "a skin face for every face");
  for (int f = 0; f < leaf.mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int s = leaf.skin.faces(f, k);
      require(s >= 0 && s < vertices &&
                  int(leaf.skin.vertex[static_cast<std::size_t>(s)]) == leaf.mesh.face_matrix()(f, k),
              "the skin's faces are the mesh's");
    }
  }
}

/// A valid blade with its petiole at the origin and on the margin, finite throughout.
inline void check_leaf(const Leaf& leaf) {
  validate_blade(leaf.mesh, leaf.positions);
  require(leaf.mesh.is_boundary(leaf.petiole), "the petiole is on the margin");
  require(leaf.positions.row(leaf.petiole).isZero(0.0), "the petiole is the origin");
  const double length = leaf_length(leaf);
  require(std::isfinite(length) && length > 0.0, "the leaf has a length");
  require(leaf.placement.rotation.allFinite() && leaf.placement.translation.allFinite() &&
              std::isfinite(leaf.placement.scale) && leaf.placement.scale > 0.0,
          "the placement is finite");
  require(leaf.stalk.centreline.allFinite() &&
              leaf.stalk.radii.size() == static_cast<std::size_t>(leaf.stalk.centreline.rows()),
          "a stalk has a radius for each of its points");
  for (const double radius : leaf.stalk.radii)
    require(std::isfinite(radius) && radius >= 0.0, "radii are finite");
  check_skin(leaf);
}

/// read() refuses, or returns such a leaf.
template <class Read>
void check_refused_or_leaf(Read&& read) {
  if (const auto leaf = unless_refused(read)) check_leaf(*leaf);
}

}  // namespace wilt::fuzz
