// Counting where a surface passes through itself.
#pragma once

#include "wilt/core/types.hpp"

namespace wilt {

/// The number of pairs of triangles that share no vertex and intersect.
///
/// Uniform grid over the triangles' boxes, then edge against triangle; touching within round-off may count
/// either way. `faces` #F x 3, `positions` #V x 3. About O(#F) for even triangles. Deterministic.
int count_self_intersections(const Faces& faces, const Points3& positions);

}  // namespace wilt
