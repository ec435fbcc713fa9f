// Several sets of points as one.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// All rows of `parts` (#P x 3 each) below each other, in their order.
inline Points3 stack_rows(const std::vector<Points3>& parts) {
  Eigen::Index count = 0;
  for (const Points3& part : parts) count += part.rows();
  Points3 all(count, 3);
  Eigen::Index row = 0;
  for (const Points3& part : parts) {
    all.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return all;
}

}  // namespace wilt
