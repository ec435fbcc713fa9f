// Pictures in memory, contact sheets, and PNG.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace wilt {

/// An 8-bit sRGB picture, rows from the top, red green blue for each pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height

  const std::uint8_t* pixel(int x, int y) const { return &rgb[3 * (std::size_t(y) * width + x)]; }
  std::uint8_t* pixel(int x, int y) { return &rgb[3 * (std::size_t(y) * width + x)]; }
};

/// Pictures row by row in `columns` columns (>= 1), `gap` pixels (>= 0) apart and around.
///
/// Every cell has the size of the largest picture; smaller ones stand in the middle of theirs.
/// Throws Error{configuration} for wrong numbers, Error{input} when there is no picture.
Image contact_sheet(const std::vector<Image>& images, int columns, int gap = 0,
                    std::array<std::uint8_t, 3> background = {237, 234, 229});

/// The picture in the bytes of a PNG or JPEG file, its transparency dropped. Throws Error{input}.
Image decode_image(std::string_view bytes);

/// The bytes of a PNG file, 8 bits RGB, lossless. Throws Error{input} for an empty picture.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the picture whole or not at all. Throws Error{output}.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace wilt
