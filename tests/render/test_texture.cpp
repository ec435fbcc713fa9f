// Maps on surfaces.
#include <gtest/gtest.h>

#include "wilt/core/random.hpp"
#include "wilt/render/texture.hpp"
#include "wilt/render/tone.hpp"

namespace wilt {
namespace {

Image noise_map(int width, int height) {
  Random random(5, "map");
  Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    image.rgb.push_back(static_cast<std::uint8_t>(random.uniform(0.0, 256.0)));
  return image;
}

// Analytic: in the middle of a pixel it is that pixel, half-way between two their mean; beyond the edge it
// goes on.
TEST(Texture, InterpolatesBetweenPixelCentres) {
  const Image image = noise_map(8, 5);
  const Texture texture(image, Texture::Kind::direction);
  const auto value = [&](int x, int y) {
    const std::uint8_t* p = image.pixel(x, y);
    return Vec3(Vec3(p[0], p[1], p[2]) / 127.5 - Vec3::Ones());
  };
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x + 1 < 8; ++x) {
      EXPECT_NEAR((texture.at({(x + 0.5) / 8, (y + 0.5) / 5}, 0.0) - value(x, y)).norm(), 0.0, 1e-6);
      EXPECT_NEAR(
          (texture.at({(x + 1.0) / 8, (y + 0.5) / 5}, 0.0) - 0.5 * (value(x, y) + value(x + 1, y))).norm(),
          0.0, 1e-6);
    }
  EXPECT_NEAR((texture.at({-3.0, 7.0}, 0.0) - value(0, 4)).norm(), 0.0, 1e-6);
}

// Conservation: from far away it is the mean of all pixels, in linear light.
TEST(Texture, FromFarAwayIsItsMean) {
  const Image image = noise_map(16, 16);
  const Texture texture(image, Texture::Kind::colour);
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 256; ++i)
    for (int c = 0; c < 3; ++c) mean[c] += decode_srgb(image.rgb[std::size_t(3 * i + c)] / 255.0) / 256.0;
  EXPECT_NEAR((texture.at({0.3, 0.7}, 10.0) - mean).norm(), 0.0, 1e-6);
}

// Property: no jump between levels: a footprint changed by 1e-6 changes the value by no more than 1e-4.
TEST(Texture, IsContinuousInItsFootprint) {
  const Texture texture(noise_map(32, 32), Texture::Kind::colour);
  for (double footprint = 0.01; footprint < 3.0; footprint *= 1.07)
    EXPECT_NEAR((texture.at({0.4, 0.4}, footprint) - texture.at({0.4, 0.4}, footprint + 1e-6)).norm(), 0.0,
                1e-4);
}

}  // namespace
}  // namespace wilt
