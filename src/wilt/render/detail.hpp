// Detail of a blade that is finer than its mesh: the network of small veins, crinkles, mottling.
#pragma once

#include <cstdint>

#include "wilt/core/types.hpp"

namespace wilt {

/// A relief and colour factors; a blade is about 1 across in the coordinates of `p`.
struct FineDetail {
  Vec2 slope = Vec2::Zero();  ///< gradient of the height
  double vein = 0.0;          ///< 0 in the tissue, 1 on a small vein
  double tone = 0.0;          ///< mottling of the colour, about -1 to 1
};
FineDetail fine_detail(const Vec2& p, std::uint64_t seed);

/// 0 below `a`, 1 above `b`, cubic between.
double smooth_step(double a, double b, double x);

}  // namespace wilt
