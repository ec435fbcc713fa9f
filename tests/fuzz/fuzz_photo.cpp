// A photo, from its pixels to a leaf of 200 vertices: 24 x 24 squares of 4 x 4 pixels, light grey where the
// bytes end.
//
// Bytes: options (bits: 1 a petiole is given, 2 the second largest leaf, 4 a threshold); then one for each
// square, three bits of red, three of green, two of blue.
#include "fuzz/leaf_checks.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/import/photo_leaf.hpp"

namespace {

using namespace wilt;

constexpr int kSquares = 24, kPixels = 4;

Image picture(fuzz::Bytes& bytes) {
  constexpr int side = kSquares * kPixels;
  Image image{side, side, std::vector<std::uint8_t>(3 * side * side)};
  for (int square = 0; square < kSquares * kSquares; ++square) {
    const int colour = bytes.left() > 0 ? bytes.byte() : 0xdb;
    for (int pixel = 0; pixel < kPixels * kPixels; ++pixel) {
      std::uint8_t* rgb = image.pixel(square % kSquares * kPixels + pixel % kPixels,
                                      square / kSquares * kPixels + pixel / kPixels);
      rgb[0] = static_cast<std::uint8_t>(36 * (colour >> 5));
      rgb[1] = static_cast<std::uint8_t>(36 * (colour >> 2 & 7));
      rgb[2] = static_cast<std::uint8_t>(84 * (colour & 3));
    }
  }
  return image;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int flags = bytes.byte();
  ReadOptions options;
  options.vertices = 200;
  if (flags & 1) options.petiole = Vec2(bytes.byte(), bytes.byte());
  if (flags & 2) options.nth = 2;
  if (flags & 4) options.threshold = 0.25 * (1 + bytes.byte());
  const std::string png = encode_png(picture(bytes));
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_photo(png, "leaf", options, {}); });
  return 0;
}
