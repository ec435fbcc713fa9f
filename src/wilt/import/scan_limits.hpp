// What a scan must be to become a leaf. Inside the import room only.
#pragma once

#include <cstddef>

namespace wilt::detail {

// Lengths in units of the leaf's size, the square root of its area.
inline constexpr std::size_t kLeastScanPoints = 300;
inline constexpr double kMostNoise = 0.04;   // refused above
inline constexpr double kMuchNoise = 0.015;  // the user is told above
inline constexpr double kMuchLeftOut = 0.1;  // share of the points beyond the margin: the user is told above
inline constexpr double kManyOutliers =
    0.05;  // share of the points far off the surface: the user is told above
inline constexpr double kMostFolded = 0.03;  // share of the surface that lies over itself when laid out

}  // namespace wilt::detail
