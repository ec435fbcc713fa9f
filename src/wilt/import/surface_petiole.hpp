// The petiole of a surface that stands in space. Inside the import room only.
#pragma once

#include <string>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt::detail {

/// ReadOptions::petiole on a margin (#M x 3, like `normal`, the blade's, in the file's coordinates): the
/// index of the nearest point in the two coordinates that remain when the axis nearest to the normal is left
/// out. Says so.
int given_petiole(const Points3& margin, const Vec3& normal, const Vec2& wanted,
                  std::vector<std::string>& notes);

/// find_petiole() on a margin laid out in the plane (#M x 2); says what was found and where (margin, as
/// above).
int guessed_petiole(const Points2& flat, const Points3& margin, std::vector<std::string>& notes);

/// Gives a leaf that has its placement a stalk; centreline #K x 3 from the blade outwards and its radii in
/// the unit of leaf.placement. The first point moves to the petiole vertex.
void place_stalk(Leaf& leaf, const Points3& centreline, const std::vector<double>& radii);

}  // namespace wilt::detail
