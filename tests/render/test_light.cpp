// What the light does: scenes whose radiance is known.
#include <gtest/gtest.h>

#include "render/scenes.hpp"
#include "wilt/render/material.hpp"

namespace wilt {
namespace {

using test::at;
using test::centre;
using test::dark_studio;

constexpr double kPi = std::numbers::pi;

// Conservation (furnace): what absorbs nothing cannot be told from a uniform sky. Exact, not only on average:
// every path ends in the same sky with weight 1; 1e-9 is round-off.
TEST(Light, AWhiteSphereInAUniformSkyIsTheSky) {
  PictureOptions options = dark_studio();
  const Vec3 sky(0.7, 0.5, 0.3);
  options.lighting.sky = test::uniform_sky(sky);
  const Radiance picture = render_radiance({{test::sphere(24, Vec3::Ones())}}, options);
  for (int y = 5; y < 11; ++y)
    for (int x = 5; x < 11; ++x) EXPECT_NEAR((at(picture, x, y) - sky).norm(), 0.0, 1e-9) << x << " " << y;
}

TEST(Light, ALeafThatAbsorbsNothingIsTheSkyEvenWhenItIsABowl) {
  for (const double height : {0.0, 0.9, -0.9}) {
    PictureOptions options = dark_studio();
    options.bounces = 4;
    options.lighting.sky = test::uniform_sky(Vec3::Constant(0.8));
    Scene scene{{test::paraboloid(12, height, Vec3::Constant(0.5), true)}};
    scene.surfaces[0].finish = test::matt(1.0);
    const Radiance picture = render_radiance(scene, options);
    for (int y = 2; y < 14; ++y)
      for (int x = 2; x < 14; ++x) EXPECT_NEAR((at(picture, x, y)).mean(), 0.8, 1e-9) << height;
  }
}

// Conservation: a white leaf that would reflect all and transmit all is cut back to what arrives.
TEST(Light, AWhiteLeafGivesNoMoreThanTheSky) {
  PictureOptions options = dark_studio();
  options.bounces = 4;
  options.lighting.sky = test::uniform_sky(Vec3::Constant(0.8));
  Scene scene{{test::paraboloid(12, 0.5, Vec3::Ones(), true)}};
  scene.surfaces[0].finish = test::matt(1.0);
  const Radiance picture = render_radiance(scene, options);
  for (int y = 2; y < 14; ++y)
    for (int x = 2; x < 14; ++x) EXPECT_NEAR(at(picture, x, y).mean(), 0.8, 1e-9);
}

// Conservation: the coat moves light, it makes none; single scattering of GGX loses a few per cent when
// rough.
TEST(Light, TheCoatMakesNoLight) {
  for (const double roughness : {0.1, 0.3, 0.6}) {
    PictureOptions options = dark_studio(8);
    options.samples = 256;
    options.lighting.sky = test::uniform_sky(Vec3::Ones());
    options.camera = frame_camera(Points3::Random(8, 3) * 0.2, 1.0, {0.3, 0.5});
    Scene scene{{test::square(1.0, 0.0, Vec3::Ones(), false)}};
    scene.surfaces[0].finish = {0.0, 1.0, roughness};
    const double mean = render_radiance(scene, options).rgb.mean();
    EXPECT_LT(mean, 1.0 + 0.005) << roughness;  // noise of 64 x 256 samples is about 0.002
    EXPECT_GT(mean, 0.94) << roughness;
  }
}

// Analytic: Lambert's cosine law, L = rho E sin(elevation) / pi.
TEST(Light, ASunlitPlaneFollowsTheCosineLaw) {
  const Vec3 rho(0.6, 0.4, 0.2), irradiance(3.0, 2.0, 1.0);
  for (const double elevation : {0.1, 0.5, 1.0, kPi / 2}) {
    PictureOptions options = dark_studio();
    options.lighting.sun = {{std::cos(elevation), 0.0, std::sin(elevation)}, 0.02, irradiance};
    const Vec3 expected = rho.cwiseProduct(irradiance) * std::sin(elevation) / kPi;
    const Vec3 seen = centre(render_radiance({{test::square(1.0, 0.0, rho, false)}}, options));
    EXPECT_NEAR((seen - expected).norm(), 0.0, 1e-9) << elevation;
  }
}

// Analytic: light from behind comes through a leaf with L = tau E |cos| / pi, and not through a solid.
TEST(Light, ALeafGlowsWhenTheSunIsBehindIt) {
  const Vec3 colour(0.3, 0.2, 0.1);
  PictureOptions options = dark_studio();
  options.lighting.sun = {{0.0, 0.6, -0.8}, 0.02, Vec3::Constant(2.0)};
  Scene scene{{test::square(1.0, 0.0, colour, true)}};
  scene.surfaces[0].finish = test::matt(0.5);
  const Vec3 tau = sheet_optics(colour, 0.5).transmittance;
  EXPECT_NEAR((centre(render_radiance(scene, options)) - tau * 2.0 * 0.8 / kPi).norm(), 0.0, 1e-9);
  scene.surfaces[0].leaf = false;
  EXPECT_EQ(centre(render_radiance(scene, options)).norm(), 0.0);
}

// Analytic: from below, in light from below, the underside's reflectance.
TEST(Light, TheUndersideIsPalerAndSeenFromBelow) {
  const Vec3 colour(0.3, 0.2, 0.05), under = sheet_optics(colour, 0.0).under;
  PictureOptions options = dark_studio();
  options.camera = Camera{{0.0, 0.0, -20.0}, Vec3::UnitZ(), Vec3::UnitY(), 0.1};
  options.lighting.sun = {-Vec3::UnitZ(), 0.0, Vec3::Constant(kPi)};
  const Vec3 seen = centre(render_radiance({{test::square(1.0, 0.0, colour, true)}}, options));
  EXPECT_NEAR((seen - under).norm(), 0.0, 1e-9);
  EXPECT_GT(under.minCoeff() / under.maxCoeff(), colour.minCoeff() / colour.maxCoeff() + 0.1);
}

// Analytic: (1 / pi) of the irradiance of the dome, rho (horizon + 2 / 3 (zenith - horizon)).
TEST(Light, APlaneUnderTheSkyReflectsTheSkysCosineMean) {
  PictureOptions options = dark_studio(8);
  options.samples = 1024;
  options.lighting.sky = {{1.0, 0.2, 0.6}, {0.1, 0.8, 0.6}, Vec3::Zero()};
  const Vec3 expected = 0.5 * Vec3(0.7, 0.4, 0.6);
  EXPECT_NEAR((0.5 * options.lighting.sky.mean_above() - expected).norm(), 0.0, 1e-15);
  const Radiance picture = render_radiance({{test::square(2.0, 0.0, Vec3::Constant(0.5), false)}}, options);
  // Standard deviation of one sample is 0.15; of 64 x 1024 it is 0.0006.
  EXPECT_NEAR((picture.rgb.colwise().mean().transpose() - expected).norm(), 0.0, 0.002);
}

// Analytic: a plate between sun and plane; full light, no light, and half the disc under the plate's edge.
TEST(Light, ShadowsAreWhereTheyMustBe) {
  PictureOptions options = dark_studio(32);
  options.samples = 256;
  options.lighting.sun = {{1.0, 0.0, 1.0}, 0.05, Vec3::Constant(kPi * std::sqrt(2.0))};
  Scene scene{
      {test::square(1.0, 0.0, Vec3::Constant(0.5), false), test::square(3.0, 2.0, Vec3::Ones(), false)}};
  // The plate spans x in [2, 8] at height 2 after this shift: its shadow covers x in [0, 6].
  scene.surfaces[1].positions.col(0).array() += 5.0;
  const Radiance picture = render_radiance(scene, options);
  EXPECT_NEAR(at(picture, 4, 16).x(), 0.5, 1e-9);
  EXPECT_NEAR(at(picture, 28, 16).x(), 0.0, 1e-9);
  double edge = 0.0;
  for (int y = 2; y < 30; ++y) edge += (at(picture, 15, y).x() + at(picture, 16, y).x()) / 56.0;
  EXPECT_NEAR(edge, 0.25, 0.006);  // half the light; three deviations of 56 x 256 samples of a step
}

// Analytic: where nothing stands before sun and sky the ground is the background, without any noise.
TEST(Light, TheOpenGroundIsTheBackgroundAndTheShadowIsDarker) {
  PictureOptions options;
  options.width = 64, options.height = 48, options.samples = 4;
  options.view.margin = 0.3;
  const Scene scene{{test::square(0.05, 0.01, Vec3(0.1, 0.3, 0.05), true)}};
  options.ground_height = 0.0;
  const Image picture = render(scene, options);
  for (int x = 0; x < 64; ++x)  // the top row: a sample in a hundred meets the leaf
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(picture.pixel(x, 0)[i], 255.0 * options.background[i], 2.0) << x;
  int dark = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t* p = picture.pixel(x, y);
      dark += p[2] > 90 && p[2] < 200 && std::abs(p[0] - p[2]) < 40;  // greyish: not the leaf
    }
  EXPECT_GT(dark, 20);
}

// A picture of one colour.
Image plain_map(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Image map{4, 4, {}};
  for (int i = 0; i < 16; ++i) map.rgb.insert(map.rgb.end(), {r, g, b});
  return map;
}

// Analytic: a tilted normal follows the cosine law about the tilted direction; x of the map runs along u, y
// against v, wherever the texture coordinates turn them.
TEST(Light, ANormalMapTiltsTheSurface) {
  PictureOptions options = dark_studio();
  options.lighting.sun = {{0.6, 0.0, 0.8}, 0.0, Vec3::Constant(kPi)};
  options.bounces = 1;  // light from the surface to itself is not asked for
  for (const double turn : {0.0, 0.5, 2.0, -1.2}) {
    Scene scene{{test::square(1.0, 0.0, Vec3::Constant(0.5), true)}};
    Surface& leaf = scene.surfaces[0];
    Eigen::Matrix2d rotation;
    rotation << std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn);
    leaf.uv = 0.25 * leaf.positions.leftCols(2) * rotation.transpose();  // (u, v) = R (x, y) / 4
    leaf.normal_map = plain_map(204, 153, 230);
    const Vec3 value(204 / 127.5 - 1.0, 153 / 127.5 - 1.0, 230 / 127.5 - 1.0);
    const Vec2 u_axis = rotation.row(0).transpose(), v_axis = rotation.row(1).transpose();
    Vec3 normal;
    normal << value.x() * u_axis - value.y() * v_axis, value.z();
    const double expected = 0.5 * normal.normalized().dot(options.lighting.sun.direction);
    EXPECT_NEAR(centre(render_radiance(scene, options)).x(), expected, 1e-6) << turn;  // the map is in floats
  }
}

// Analytic: a colour map multiplies the colours, each half in its own.
TEST(Light, AColourMapMultipliesTheColours) {
  PictureOptions options = dark_studio(32);
  options.lighting.sun = {Vec3::UnitZ(), 0.0, Vec3::Constant(kPi)};
  Scene scene{{test::square(1.0, 0.0, Vec3(0.5, 0.4, 0.3), false)}};
  Surface& plate = scene.surfaces[0];
  plate.uv = (0.5 * plate.positions.leftCols(2)).array() + 0.5;
  plate.uv.col(1) = 1.0 - plate.uv.col(1).array();  // glTF: v runs down
  plate.colour_map = {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  const Radiance picture = render_radiance(scene, options);
  EXPECT_NEAR((at(picture, 3, 3) - Vec3(0.5, 0.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((at(picture, 28, 3) - Vec3(0.0, 0.4, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((at(picture, 3, 28) - Vec3(0.0, 0.0, 0.3)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((at(picture, 28, 28) - Vec3(0.5, 0.4, 0.3)).norm(), 0.0, 1e-6);
}

TEST(SheetOptics, GreyStaysGreyAndNothingIsGained) {
  const SheetOptics grey = sheet_optics(Vec3::Constant(0.5), 1.0);
  EXPECT_NEAR((grey.under - Vec3::Constant(0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((grey.transmittance - Vec3::Constant(0.5)).norm(), 0.0, 1e-15);
  // Property: colours stay in [0, 1].
  Random random(7, "sheet_optics");
  for (int i = 0; i < 200; ++i) {
    const Vec3 colour(random.uniform(), random.uniform(), random.uniform());
    const SheetOptics optics = sheet_optics(colour, random.uniform());
    EXPECT_GE(optics.transmittance.minCoeff(), 0.0);
    EXPECT_LE(optics.under.maxCoeff(), 1.0);
    EXPECT_TRUE((optics.transmittance.array() <= colour.array() + 1e-15).all());
  }
}

}  // namespace
}  // namespace wilt
