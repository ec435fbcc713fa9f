// Bytes: tone curve, contact sheets.
#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/render/contact_sheet.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/render/tone.hpp"

namespace wilt {
namespace {

Image noise_image(int width, int height, std::uint64_t seed) {
  Random random(seed, "image");
  Image image{width, height, std::vector<std::uint8_t>(3 * width * height)};
  for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(random.index(256));
  return image;
}

// Analytic: the curve's two conditions; round trip to round-off; monotone.
TEST(Tone, KeepsMiddleGreyAndInverts) {
  EXPECT_NEAR(tone(0.18), 0.18, 1e-12);
  EXPECT_NEAR(tone(kToneWhite), 1.0, 1e-12);
  EXPECT_EQ(tone(100.0), 1.0);
  EXPECT_EQ(tone(0.0), 0.0);
  for (double x = 0.01; x < kToneWhite; x += 0.05) {
    EXPECT_NEAR(inverse_tone(tone(x)), x, 1e-9);
    EXPECT_LT(tone(x), tone(x + 0.05));
  }
}

// Analytic: IEC 61966-2-1 has 0.214041 for an encoded 0.5.
TEST(Tone, SrgbHasItsStandardValues) {
  EXPECT_NEAR(decode_srgb(0.5), 0.2140411, 1e-6);
  EXPECT_NEAR(encode_srgb(0.2140411), 0.5, 1e-6);
  EXPECT_NEAR(encode_srgb(0.001), 0.01292, 1e-9);
}

// Analytic: a colour that is asked for is the colour that is shown.
TEST(Tone, RadianceOfAColourDevelopsToIt) {
  for (int level = 0; level <= 255; level += 5) {
    Radiance one{1, 1, Points3(1, 3)};
    one.rgb.row(0) = radiance_of(Vec3::Constant(level / 255.0)).transpose();
    EXPECT_EQ(int(develop(one).rgb[0]), level);
    one.rgb /= 2.0;
    EXPECT_EQ(int(develop(one, 2.0).rgb[1]), level);
  }
}

// Analytic: every pixel of every picture is where rows and columns say; the rest is background.
TEST(ContactSheet, PutsPicturesInRows) {
  const std::vector<Image> images = {noise_image(4, 3, 1), noise_image(4, 3, 2), noise_image(2, 1, 3)};
  const Image sheet = contact_sheet(images, 2, 1, {9, 8, 7});
  ASSERT_EQ(sheet.width, 11);
  ASSERT_EQ(sheet.height, 9);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 12; ++x) {
      EXPECT_EQ(sheet.pixel(1, 1 + y)[x], images[0].pixel(0, y)[x]);
      EXPECT_EQ(sheet.pixel(6, 1 + y)[x], images[1].pixel(0, y)[x]);
    }
  for (int x = 0; x < 6; ++x) EXPECT_EQ(sheet.pixel(2, 6)[x], images[2].pixel(0, 0)[x]);  // in the middle
  for (int i = 0; i < 3; ++i) EXPECT_EQ(int(sheet.pixel(8, 6)[i]), 9 - i);
  EXPECT_THROW(contact_sheet({}, 2), Error);
  EXPECT_THROW(contact_sheet(images, 0), Error);
}

}  // namespace
}  // namespace wilt
