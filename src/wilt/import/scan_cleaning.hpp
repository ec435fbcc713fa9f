// From the raw points of a scan to those of a surface. Inside the import room only.
#pragma once

#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::detail {

struct CleanScan {
  Points3 points;               ///< #P x 3, in an order that does not depend on the file's
  Points3 smooth;               ///< #P x 3, moved onto the surface that their neighbours suggest
  Points3 normals;              ///< #P x 3, of that surface, either side
  Points3 strays;               ///< #S x 3, too far from the others
  double spacing = 0.0;         ///< between neighbours on the surface: sqrt(area per point), the median
  double coarse_spacing = 0.0;  ///< where the scan is sparse: its 95th percentile
};

/// Drops repeated points, takes every k-th where there are more than 40,000, drops strays (statistical
/// outlier removal, Rusu et al. 2008: mean distance to 12 neighbours, here against the median), and moves the
/// others onto local quadrics (moving least squares, Levin 1998). What was done is said in `notes`. Throws
/// Error{input} for fewer than 300 points, and for points on a line. O(#P log #P).
CleanScan clean_scan(const Points3& raw, std::vector<std::string>& notes);

}  // namespace wilt::detail
