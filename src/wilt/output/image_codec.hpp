// Pictures as bytes of a file: JPEG out, JPEG and PNG in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wilt {

/// 8-bit sRGB, row by row from the top left.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 per pixel
};

/// A JPEG, quality 1 to 100; above 90 colour is not subsampled. Throws std::logic_error for a wrong size,
/// Error{output} when it cannot be encoded (more than 65535 pixels on a side).
std::string encode_jpeg(const Picture& picture, int quality = 95);

/// Reads a PNG or a JPEG; an alpha channel is dropped. Throws Error{input} with the reason when it is
/// neither, or damaged.
Picture decode_picture(std::string_view bytes);

}  // namespace wilt
