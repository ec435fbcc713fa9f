#include "wilt/core/image_codec.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

Image gradient(int width, int height) {
  Image picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {4 * x, 3 * y, 255 - 2 * x - y})
        picture.rgb.push_back(static_cast<std::uint8_t>(value));
  return picture;
}

// Round trip: quality 95 keeps a smooth picture within 4 of 255.
TEST(ImageCodec, JpegComesBack) {
  const Image picture = gradient(61, 40);
  const std::string bytes = encode_jpeg(picture);
  EXPECT_EQ(bytes.substr(0, 2), "\xff\xd8");
  const Image back = decode_image(bytes);
  ASSERT_EQ(back.width, 61);
  ASSERT_EQ(back.height, 40);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    ASSERT_LE(std::abs(int(picture.rgb[i]) - int(back.rgb[i])), 4) << i;
  EXPECT_EQ(encode_jpeg(picture), bytes);
}

// Round trip: a PNG loses nothing.
TEST(ImageCodec, PngComesBackExactly) {
  const Image picture = gradient(61, 40);
  EXPECT_EQ(decode_image(encode_png(picture)).rgb, picture.rgb);
}

// Negative: bytes that are no picture, and a picture that is cut off.
TEST(ImageCodec, RefusesWhatIsNoPicture) {
  EXPECT_THROW(decode_image(""), Error);
  EXPECT_THROW(decode_image("v 0 0 0"), Error);
  const std::string bytes = encode_jpeg(gradient(32, 32));
  EXPECT_THROW(decode_image(bytes.substr(0, 20)), Error);
  EXPECT_THROW(encode_jpeg({4, 4, {1, 2, 3}}), std::logic_error);
}

// Past fault: stb_image writes beyond its tables for a JPEG that states more codes than there can be.
// Metadata and what follows the image may hold anything. Oracle: the pixels without it.
TEST(ImageCodec, RefusesJpegTablesThatAreTooLong) {
  const std::string bytes = encode_jpeg(gradient(32, 32)), start = bytes.substr(0, 2), rest = bytes.substr(2);
  const std::string counts = "\x10" + std::string(2, '\xff') + std::string(14, '\0');
  const std::string table = std::string("\xff\xc4\x02\x11", 4) + counts + std::string(510, '\1');
  EXPECT_THROW(decode_image(start + table + rest), Error);
  EXPECT_THROW(decode_image(start + "\xff" + table + rest), Error);
  EXPECT_THROW(decode_image(bytes.substr(0, bytes.size() - 2) + table), Error);
  EXPECT_THROW(decode_image("\xff" + start + table + rest), Error);
  EXPECT_THROW(decode_image(start + std::string("\xff\xc4\0\3", 4) + counts + rest), Error);
  const std::string comment = std::string("\xff\xfe\x02\x15", 4) + table;
  EXPECT_EQ(decode_image(start + comment + rest + table).rgb, decode_image(bytes).rgb);
}

}  // namespace
}  // namespace wilt
