// The sRGB transfer curve (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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

/// Linear values as eight bits of sRGB, within a step of the rounded value.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(double(i) / kSteps)));
  }
  std::uint8_t operator()(double linear) const {
    return table_[static_cast<std::size_t>(std::clamp(linear, 0.0, 1.0) * kSteps + 0.5)];
  }

 private:
  static constexpr int kSteps = 16384;
  std::array<std::uint8_t, kSteps + 1> table_{};
};

}  // namespace wilt
