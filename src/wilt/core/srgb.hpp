// The sRGB transfer curve (IEC 61966-2-1).
#pragma once

#include <array>
#include <cmath>

#include "wilt/core/types.hpp"

namespace wilt {

/// A linear value as it is encoded, both in [0, 1].
inline double encode_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Its inverse.
inline double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The luminance of linear RGB (IEC 61966-2-1, Rec. 709 primaries).
inline double luminance(const Vec3& linear) {
  return linear.dot(Vec3(0.2126, 0.7152, 0.0722));
}

/// 8-bit sRGB to linear RGB.
inline Vec3 linear_rgb(const std::array<int, 3>& srgb) {
  return {decode_srgb(srgb[0] / 255.0), decode_srgb(srgb[1] / 255.0), decode_srgb(srgb[2] / 255.0)};
}

}  // namespace wilt
