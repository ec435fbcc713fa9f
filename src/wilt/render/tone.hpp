// From linear light to what a screen shows, and back.
#pragma once

#include "wilt/core/srgb.hpp"

namespace wilt {

/// The filmic curve of T. Lottes, "Advanced Techniques and Optimization of HDR Color Pipelines" (GDC 2016),
/// without shoulder control: y = x^a / (b x^a + c), for x >= 0. Middle grey 0.18 stays, kToneWhite becomes 1.
inline constexpr double kToneContrast = 1.25;  // a
inline constexpr double kToneWhite = 6.0;
double tone(double x);          ///< in [0, 1]: clipped above kToneWhite
double inverse_tone(double y);  ///< for y in [0, 1]

/// The radiance that is shown as the given sRGB colour.
Vec3 radiance_of(const Vec3& srgb);

}  // namespace wilt
