// Veins as polylines at rest: what every vein file holds.
#pragma once

#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// A vein as points; row i of both is point i of the vein's path.
struct RestVein {
  int order = 1;      ///< 1: primary, 2: secondary
  int tip = -1;       ///< primary: the index of its tip
  Points3 positions;  ///< #P x 3, metres, leaf frame, at rest
  Points2 uv;         ///< #P x 2, glTF convention, of the leaf's skin
};

/// One line per vein, in the order of `venation.veins`. The path's points lie in the leaf's faces.
std::vector<RestVein> vein_lines(const Leaf& leaf, const Venation& venation);

/// The texture coordinates of a blade vertex: of its first skin vertex. O(#S).
Vec2 vertex_uv(const Leaf& leaf, VertexId vertex);

}  // namespace wilt
