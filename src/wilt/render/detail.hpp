// Detail of a blade that is finer than its mesh: the network of small veins, crinkles, mottling.
#pragma once

#include <cstdint>

#include "wilt/core/types.hpp"

namespace wilt {

/// Smooth noise in the plane with its gradient: cubic between random values in [-1, 1] on the integers.
struct Noise {
  double value = 0.0;
  Vec2 gradient = Vec2::Zero();
};
Noise value_noise(const Vec2& p, std::uint64_t seed);

/// Distance to the nearest wall between the cells of random points, one in each unit square (Worley).
struct CellWall {
  double distance = 0.0;       ///< to the line half-way between the two nearest points
  Vec2 gradient = {0.0, 0.0};  ///< of the distance
};
CellWall cell_wall(const Vec2& p, std::uint64_t seed);

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
