// A stalk of which a scan holds a few points only. Inside the import room only.
#pragma once

#include <optional>

#include "wilt/core/types.hpp"

namespace wilt::detail {

/// Where the longest trail of loose points (#L x 3) leaves the margin (#M x 3): the index of the margin
/// point. A trail is points not farther than `reach` from each other and from the margin, six or more, longer
/// than a quarter of `size`, thin, and leading away from the blade. All lengths in one unit.
std::optional<int> find_stalk_trail(const Points3& loose, const Points3& margin, double reach, double size);

}  // namespace wilt::detail
