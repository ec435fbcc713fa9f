// The points of a scan as they stand in a file. Inside the import room only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::detail {

/// Points from text (.xyz .txt .csv): a point a line, x y z and whatever follows, separated by
/// spaces, commas, semicolons or tabs. Lines that begin with # or // are left out; a line of names (a comment
/// too) tells which columns are x, y and z, else they are the first three. Points that are no numbers ("nan")
/// are left out and counted in `notes`. Throws Error{input}, naming the line, for rows that do not agree with
/// the first or hold other words, and for more than 20 million points.
Points3 parse_points(std::string_view text, std::vector<std::string>& notes);

}  // namespace wilt::detail
