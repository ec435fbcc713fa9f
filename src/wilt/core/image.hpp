// A picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace wilt {

/// 8 bits a channel, sRGB unless said otherwise; rows from the top, red green blue for each pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height

  bool empty() const { return rgb.empty(); }
  const std::uint8_t* pixel(int x, int y) const { return &rgb[3 * (std::size_t(y) * width + x)]; }
  std::uint8_t* pixel(int x, int y) { return &rgb[3 * (std::size_t(y) * width + x)]; }
};

}  // namespace wilt
