#include <gtest/gtest.h>

#include "wilt/game/deep_image.hpp"

namespace wilt {
namespace {

// Oracle: the PNG specification, section 11.2.2: bit depth and colour type are bytes 24 and 25 of a file.
TEST(DeepImage, IsSixteenBitsOfThreeColoursWhateverItShows) {
  DeepImage image;
  image.width = 3;
  image.height = 2;
  image.texels.setZero(6, 3);
  const std::string png = encode_png16(image);
  ASSERT_GT(png.size(), 26u);
  EXPECT_EQ(int(png[24]), 16);
  EXPECT_EQ(int(png[25]), 2);
}

}  // namespace
}  // namespace wilt
