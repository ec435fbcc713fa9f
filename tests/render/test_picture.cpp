// Pictures as a whole: determinism, invariance, framing, errors.
#include <gtest/gtest.h>

#include <limits>

#include "render/scenes.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/random.hpp"

namespace wilt {
namespace {

Scene bowl() {
  Scene scene{{test::paraboloid(10, 0.4, Vec3(0.4, 0.3, 0.1), true)}};
  scene.surfaces[0].finish = {};
  return scene;
}

PictureOptions small() {
  PictureOptions options;
  options.width = 50, options.height = 37, options.samples = 4;  // no multiple of a tile
  return options;
}

std::string error_of(const std::function<void()>& call, ErrorCode code) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

// Differential: one thread against many.
TEST(Picture, HasTheSameBytesForAnyNumberOfThreads) {
  Image one, many;
  {
    const ThreadLimit limit(1);
    one = render(bowl(), small());
  }
  {
    const ThreadLimit limit(4);
    many = render(bowl(), small());
  }
  EXPECT_EQ(one.rgb, many.rgb);
}

// Invariance: another seed is other noise about the same picture.
TEST(Picture, AnotherSeedIsOtherNoiseOfTheSamePicture) {
  const Scene scene = bowl();
  PictureOptions options = small();
  options.samples = 16;
  const Radiance a = render_radiance(scene, options);
  options.seed = 2;
  const Radiance b = render_radiance(scene, options);
  EXPECT_GT((a.rgb - b.rgb).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(a.rgb.mean(), b.rgb.mean(), 0.005 * a.rgb.mean());
}

// Invariance: a leaf in millimetres, far from the origin, gives the same picture but for the rounding of
// single-precision rays, which may turn single samples at edges: a mean of half a level.
TEST(Picture, DoesNotDependOnUnitAndPlace) {
  const Scene scene = bowl();
  Scene far = scene;
  const Eigen::RowVector3d shift(400.0, -200.0, 300.0);
  far.surfaces[0].positions = (scene.surfaces[0].positions * 1000.0).rowwise() + shift;
  const Image a = render(scene, small()), b = render(far, small());
  double difference = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) difference += std::abs(int(a.rgb[i]) - int(b.rgb[i]));
  EXPECT_LT(difference / a.rgb.size(), 0.5);
}

// Analytic: the lit pixels fill the frame up to the margin, in the direction that binds.
TEST(Picture, TheAutomaticCameraFillsTheFrameUpToTheMargin) {
  PictureOptions options = test::dark_studio(100);
  options.height = 60;
  options.camera.reset();
  options.lighting.sky = test::uniform_sky(Vec3::Ones());
  options.view.margin = 0.1;
  const Radiance picture = render_radiance({{test::sphere(24, Vec3::Ones())}}, options);
  int left = 100, right = -1, top = 60, bottom = -1;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) {
      if (test::at(picture, x, y).x() < 0.5) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
      bottom = std::max(bottom, y);
    }
  EXPECT_NEAR(top, 6, 1);
  EXPECT_NEAR(bottom, 53, 1);
  EXPECT_NEAR(0.5 * (left + right), 49.5, 1.0);
  EXPECT_NEAR(right - left, bottom - top, 1.0);  // round: pixels are square
}

// Differential: where a pixel stops early, its mean is that of all its samples within the noise that was
// asked for.
TEST(Picture, StopsEarlyOnlyWhereItIsSmooth) {
  PictureOptions options = small();
  options.samples = 256, options.noise = 0.0;
  const Radiance all = render_radiance(bowl(), options);
  options.noise = 0.02;
  const Radiance early = render_radiance(bowl(), options);
  const Eigen::ArrayXd error = (early.rgb - all.rgb).rowwise().mean().array().abs();
  const Eigen::ArrayXd scale = all.rgb.rowwise().mean().array() + 0.1;
  EXPECT_GT((error > 0.0).count(), error.size() / 4);  // it did stop
  EXPECT_LT((error / scale).mean(), 0.02);
  EXPECT_LT((error / scale).maxCoeff(), 0.12);  // six deviations
}

TEST(Picture, ReportsProgressAndStopsWhenAsked) {
  double last = -1.0;
  Monitor monitor;
  monitor.progress = [&](std::string_view, double fraction) {
    EXPECT_GT(fraction, last);
    last = fraction;
  };
  render(bowl(), small(), monitor);
  EXPECT_EQ(last, 1.0);
  monitor = {};
  monitor.cancelled = [] { return true; };
  error_of([&] { render(bowl(), small(), monitor); }, ErrorCode::interrupted);
}

TEST(Picture, RefusesWhatCannotBeDrawn) {
  const auto refused = [](const Scene& scene) {
    return error_of([&] { render(scene, small()); }, ErrorCode::input);
  };
  EXPECT_NE(refused({}).find("empty"), std::string::npos);
  Scene scene = bowl();
  scene.surfaces[0].faces(3, 1) = 1000;
  EXPECT_NE(refused(scene).find("face 3 names vertex 1000"), std::string::npos);
  scene = bowl();
  scene.surfaces[0].colours(0, 0) = 1.5;
  EXPECT_NE(refused(scene).find("colour"), std::string::npos);
  scene = bowl();
  scene.surfaces[0].positions(5, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(scene).find("position"), std::string::npos);
  scene = bowl();
  scene.surfaces[0].colours.conservativeResize(4, 3);
  EXPECT_NE(refused(scene).find("4 colours"), std::string::npos);
  scene = bowl();
  scene.surfaces[0].finish.gloss = 2.0;
  EXPECT_NE(refused(scene).find("gloss is 2"), std::string::npos);
  scene = bowl();
  scene.surfaces[0].colour_map = {2, 2, std::vector<std::uint8_t>(12)};
  EXPECT_NE(refused(scene).find("colour map: the surface has no texture coordinates"), std::string::npos);
  scene.surfaces[0].normal_map = {2, 2, std::vector<std::uint8_t>(11)};
  scene.surfaces[0].colour_map = {};
  EXPECT_NE(refused(scene).find("2 x 2 pixels with 11 bytes"), std::string::npos);
}

TEST(Picture, RefusesWrongOptions) {
  const auto refused = [](const std::function<void(PictureOptions&)>& change) {
    PictureOptions options = small();
    change(options);
    return error_of([&] { render(bowl(), options); }, ErrorCode::configuration);
  };
  EXPECT_NE(refused([](auto& o) { o.width = 0; }).find("width is 0"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.samples = -3; }).find("samples"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.noise = -1.0; }).find("noise"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.bounces = 0; }).find("bounces"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.exposure = 0.0; }).find("exposure"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.background.x() = 2.0; }).find("background"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.lighting.sun.direction.setZero(); }).find("sun"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.view.margin = 0.5; }).find("margin"), std::string::npos);
  EXPECT_NE(refused([](auto& o) {
              o.camera = Camera{{0, 0, 9}, {0, 0, -1}, {0, 0, 1}};
            }).find("up"),
            std::string::npos);
}

// Property: in any view of any points all are within the margin, and the binding axis touches both sides.
TEST(Camera, FramesEveryPointTightly) {
  Random random(11, "camera");
  for (int trial = 0; trial < 200; ++trial) {
    Points3 points(30, 3);
    for (int i = 0; i < points.size(); ++i) points.data()[i] = random.uniform(-1.0, 1.0) + 5.0;
    const double aspect = random.uniform(0.5, 2.0);
    const View view{random.uniform(-4.0, 4.0), random.uniform(-1.57, 1.57), random.uniform(0.05, 1.2),
                    random.uniform(0.0, 0.3)};
    const Camera camera = frame_camera(points, aspect, view);
    Eigen::Vector2d low(9.0, 9.0), high(-9.0, -9.0);
    for (int i = 0; i < points.rows(); ++i) {
      const Projection p = project(camera, aspect, points.row(i).transpose());
      EXPECT_GT(p.depth, 0.0);
      low = low.cwiseMin(Eigen::Vector2d(p.x, p.y)), high = high.cwiseMax(Eigen::Vector2d(p.x, p.y));
    }
    const double limit = 1.0 - 2.0 * view.margin;
    EXPECT_GE(low.minCoeff(), -limit - 1e-9) << trial;
    EXPECT_LE(high.maxCoeff(), limit + 1e-9) << trial;
    EXPECT_NEAR((high - low).maxCoeff(), 2.0 * limit, 1e-9) << trial;
  }
}

}  // namespace
}  // namespace wilt
