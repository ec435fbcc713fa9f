// Pictures as bytes of a file: PNG and JPEG.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/image.hpp"

namespace wilt {

/// A JPEG, quality 1 to 100 (clipped), colour at full resolution. Throws std::logic_error for a wrong size,
/// Error{output} when it cannot be encoded (more than 65535 pixels on a side).
std::string encode_jpeg(const Image& image, int quality = 95);

/// A PNG, lossless. Throws std::logic_error for a wrong size, Error{output} when it cannot be encoded.
std::string encode_png(const Image& image);

/// Reads a PNG or a JPEG; an alpha channel is dropped. Throws Error{input} with the reason when it is
/// neither, damaged, or of more than 250 million pixels.
Image decode_image(std::string_view bytes);

/// The opacity of a PNG's pixels, 255 opaque, row by row; empty when the picture has no alpha channel. Throws
/// as decode_image does.
std::vector<std::uint8_t> decode_alpha(std::string_view bytes);

/// Whether the bytes of a picture are a JPEG's.
bool is_jpeg(std::string_view bytes);

/// The picture at another size, filtered in linear light; its own at its own size.
Image resized(const Image& image, int width, int height);

}  // namespace wilt
