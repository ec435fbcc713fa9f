// Labels: every map against what the geometry says.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>

#include "output/sample_leaf.hpp"
#include "render/scenes.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/render/label_files.hpp"
#include "wilt/render/label_maps.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/render/picture.hpp"

namespace wilt {
namespace {

constexpr int kWidth = 151, kHeight = 120;
constexpr double kAspect = double(kWidth) / kHeight;

GlbFile sample_file(double scale = 1.0) {
  test::Sample sample;
  sample.leaf.placement.scale = scale;
  return parse_glb(glb_bytes(sample.clip()), "sample");
}

/// The sample leaf flattened: its rest is a plane, so that places on it can be computed.
GlbFile flat_file() {
  test::Sample sample;
  sample.leaf.positions.col(2).setZero();
  for (Frame& frame : sample.frames) frame.positions.col(2).setZero();
  return parse_glb(glb_bytes(sample.clip()), "flat");
}

/// A file that only says its unit, for scenes made by hand.
GlbFile bare_file() {
  GlbFile file = sample_file();
  file.veins.clear();
  return file;
}

Camera camera_of(const Scene& scene) {
  return frame_camera(scene_points(scene), kAspect, View{});
}

Vec3 ray_of(const Camera& camera, int x, int y) {  // its part along the camera's axis is 1
  const CameraAxes axes = camera_axes(camera);
  const double t = std::tan(0.5 * camera.field_of_view);
  return axes.forward + t * kAspect * (2.0 * (x + 0.5) / kWidth - 1.0) * axes.right +
         t * (1.0 - 2.0 * (y + 0.5) / kHeight) * axes.up;
}

/// What a painter of triangles finds at a pixel's middle.
struct Drawn {
  double depth = std::numeric_limits<double>::infinity();
  int part = 0;
  bool unsure = false;  // within 1e-3 pixels of an edge that is not behind
};

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

void draw(const Surface& surface, const Camera& camera, std::vector<Drawn>& pixels) {
  for (int f = 0; f < surface.faces.rows(); ++f) {
    Vec2 p[3];
    Vec3 inverse_depth;
    for (int c = 0; c < 3; ++c) {
      const Projection q = project(camera, kAspect, surface.positions.row(surface.faces(f, c)).transpose());
      p[c] = {0.5 * (1.0 + q.x) * kWidth, 0.5 * (1.0 - q.y) * kHeight};
      inverse_depth[c] = 1.0 / q.depth;
    }
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    for (int y = std::max(0, int(low.y()) - 1); y < std::min(kHeight, int(high.y()) + 2); ++y) {
      for (int x = std::max(0, int(low.x()) - 1); x < std::min(kWidth, int(high.x()) + 2); ++x) {
        const Vec2 q(x + 0.5, y + 0.5);
        Vec3 weights;
        double inside = std::numeric_limits<double>::infinity();  // pixels to the nearest side
        for (int c = 0; c < 3; ++c) {
          const Vec2 a = p[(c + 1) % 3], b = p[(c + 2) % 3];
          weights[c] = cross(b - a, q - a) / area;
          inside = std::min(inside, weights[c] * std::abs(area) / (b - a).norm());
        }
        Drawn& pixel = pixels[std::size_t(y * kWidth + x)];
        const double depth = 1.0 / weights.dot(inverse_depth);
        if (std::abs(inside) < 1e-3) pixel.unsure = true;
        if (inside < 0.0 || depth >= pixel.depth) continue;
        pixel.depth = depth, pixel.part = int(surface.part);
      }
    }
  }
}

// Oracle: an independent painter (projected triangles, a depth buffer). Parts agree at every pixel whose
// middle is not on an edge, depths to single precision; the box and the area are those of the painter.
TEST(LabelMaps, ShowPartAndDepthOfAnIndependentProjection) {
  const GlbFile file = sample_file();
  const Scene scene = LeafScene(file).at(3.0);
  const Camera camera = camera_of(scene);
  const LabelMaps maps = LeafLabels(file).maps(scene, camera, kWidth, kHeight);
  std::vector<Drawn> drawn(std::size_t(kWidth) * kHeight);
  for (const Surface& surface : scene.surfaces) draw(surface, camera, drawn);
  int parts[3] = {0, 0, 0}, compared = 0, left = kWidth, right = -1, top = kHeight, bottom = -1, area = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const int x = int(i) % kWidth, y = int(i) / kWidth;
    if (maps.part[i] != 0) {
      ++area;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
      bottom = std::max(bottom, y);
    }
    if (drawn[i].unsure) continue;
    ++compared, ++parts[drawn[i].part];
    ASSERT_EQ(int(maps.part[i]), drawn[i].part) << x << ' ' << y;
    if (drawn[i].part == 0) {
      EXPECT_TRUE(std::isinf(maps.depth[i]));
    } else {
      EXPECT_NEAR(double(maps.depth[i]), drawn[i].depth, 2e-6 * drawn[i].depth) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 0.95 * kWidth * kHeight);
  for (const int count : parts) EXPECT_GT(count, 50);
  EXPECT_EQ(maps.box, (std::array<int, 4>{left, top, right - left + 1, bottom - top + 1}));
  EXPECT_EQ(maps.area, area);
}

// Differential: a leaf that glows in the dark is where the labels say: a pixel of the mask whose neighbours
// are all of the leaf is white in the picture, one whose neighbours are all background is black.
TEST(LabelMaps, CoverWhatThePictureShows) {
  const GlbFile file = sample_file();
  Scene scene = LeafScene(file).at(2.0);
  const Camera camera = camera_of(scene);
  const LabelMaps maps = LeafLabels(file).maps(scene, camera, kWidth, kHeight);
  PictureOptions options;
  options.width = kWidth, options.height = kHeight, options.samples = 4, options.camera = camera;
  options.ground = false, options.background = Vec3::Zero();
  options.lighting.sky = test::uniform_sky(Vec3(1.0, 1.0, 1.0));
  const Radiance picture = render_radiance(scene, options);
  int leaf = 0, ground = 0;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      int around = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) around += maps.part[std::size_t((y + j) * kWidth + x + i)] != 0;
      const double light = test::at(picture, x, y).maxCoeff();
      if (around == 9) ++leaf;
      if (around == 0) ++ground;
      if (around == 0 || around == 9) {
        EXPECT_EQ(light > 0.0, around == 9) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(leaf, 2000);
  EXPECT_GT(ground, 2000);
}

// Analytic: a tilted square, seen from either side. Depth in metres whatever the file's unit.
TEST(LabelMaps, GiveDepthAndNormalOfAPlane) {
  for (const double scale : {1.0, 100.0}) {
    GlbFile file = sample_file(scale);
    file.veins.clear();
    const Vec3 normal = Vec3(0.3, -0.5, 0.8).normalized();
    Scene scene{{test::square(1.0, 0.0, Vec3::Ones(), true)}};
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal);
    scene.surfaces[0].positions *= turn.toRotationMatrix().transpose();
    for (const double side : {1.0, -1.0}) {
      const Camera camera{side * 6.0 * Vec3(0.2, -0.1, 1.0), -side * Vec3(0.2, -0.1, 1.0), Vec3::UnitY(),
                          0.4};
      const CameraAxes axes = camera_axes(camera);
      const LabelMaps maps = LeafLabels(file).maps(scene, camera, kWidth, kHeight);
      const Vec3 expected =
          side * Vec3(normal.dot(axes.right), normal.dot(axes.up), -normal.dot(axes.forward));
      EXPECT_GT(expected.z(), 0.0);
      int seen = 0;
      for (int i = 0; i < kWidth * kHeight; ++i) {
        if (maps.part[std::size_t(i)] == 0) continue;
        ++seen;
        const Vec3 ray = ray_of(camera, i % kWidth, i / kWidth);
        const double depth = -camera.eye.dot(normal) / ray.dot(normal) / scale;
        EXPECT_NEAR(double(maps.depth[std::size_t(i)]), depth, 2e-6 * depth);
        EXPECT_LT((maps.normals.row(i).cast<double>().transpose() - expected).norm(), 1e-6);
      }
      EXPECT_GT(seen, 3000);
    }
  }
}

// Analytic: a sphere's normal is the way from its middle. Facets as wide as h = 0.056 lie h^2 / 8 = 4e-4
// below the sphere; seen at a sine of 0.2 that moves the point by 2e-3, and normals between corners err as
// much.
TEST(LabelMaps, GiveTheNormalsOfASphere) {
  const GlbFile file = bare_file();
  const Scene scene{{test::sphere(80, Vec3::Ones())}};
  const Camera camera{{3.0, -20.0, 4.0}, {-3.0, 20.0, -4.0}, Vec3::UnitZ(), 0.11};
  const CameraAxes axes = camera_axes(camera);
  const LabelMaps maps = LeafLabels(file).maps(scene, camera, kWidth, kHeight);
  int seen = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const Vec3 n = maps.normals.row(i).cast<double>().transpose();
    if (maps.part[std::size_t(i)] == 0) {
      EXPECT_EQ(n.norm(), 0.0);
      continue;
    }
    EXPECT_GE(n.z(), -0.05);  // of a perspective: faces towards the eye, not the plane of the picture
    const Vec3 point =
        camera.eye + double(maps.depth[std::size_t(i)]) * ray_of(camera, i % kWidth, i / kWidth);
    const Vec3 out = point.normalized();
    const Vec3 expected(out.dot(axes.right), out.dot(axes.up), -out.dot(axes.forward));
    if (expected.z() < 0.2) continue;
    ++seen;
    EXPECT_LT((n - expected).norm(), 4e-3) << i;
  }
  EXPECT_GT(seen, 5000);
}

/// The flat leaf at rest; `plane(i)` is the place that pixel i shows, where it shows the blade's plane.
struct FlatLeaf {
  GlbFile file = flat_file();
  LeafScene shown{file};
  Scene scene = shown.at(0.0);
  Camera camera = camera_of(scene);

  Points3 blade() const {  // at the vertices of the file
    return scene.surfaces[0].positions.topRows(file.meshes[0].frames[0].rows());
  }
  std::optional<Vec3> place(const LabelMaps& maps, int i) const {
    const Points3 points = blade();
    const Vec3 a = points.row(0).transpose(), b = points.row(6).transpose(), c = points.row(30).transpose();
    const Vec3 normal = (b - a).cross(c - a).normalized(), ray = ray_of(camera, i % kWidth, i / kWidth);
    const double depth = (a - camera.eye).dot(normal) / ray.dot(normal);
    const bool on_it = maps.part[std::size_t(i)] == std::uint8_t(Part::blade) &&
                       std::abs(double(maps.depth[std::size_t(i)]) - depth) < 3e-6;
    if (!on_it) return std::nullopt;  // the rim, the stalk or the ground
    return camera.eye + depth * ray;
  }
};

// Analytic: water that is linear over the flat blade is that at every pixel (so it is linear in every
// triangle, refined or not); beside the blade there is none, on its rim it is in between.
TEST(LabelMaps, GiveWaterThatIsLinearAcrossTriangles) {
  const FlatLeaf leaf;
  const Vec3 slope(3.0, 4.0, 0.0);
  const Eigen::VectorXd water = (leaf.blade() * slope).array() + 0.3;
  const LabelMaps maps = LeafLabels(leaf.file).maps(leaf.shown.at(0.0, water), leaf.camera, kWidth, kHeight);
  int seen = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double value = maps.water[std::size_t(i)];
    if (maps.part[std::size_t(i)] != std::uint8_t(Part::blade)) {
      EXPECT_EQ(value, 0.0);
      continue;
    }
    EXPECT_GE(value, water.minCoeff() - 1e-6);
    EXPECT_LE(value, water.maxCoeff() + 1e-6);
    const auto place = leaf.place(maps, i);
    if (!place) continue;
    ++seen;
    EXPECT_NEAR(value, 0.3 + slope.dot(*place), 2e-5) << i;
  }
  EXPECT_GT(seen, 3000);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

// Where the points of a vein stand in the scene.
std::vector<Vec3> vein_in(const GlbFile& file, const GlbVein& vein, const Points3& blade) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < vein.faces.size(); ++i) {
    Vec3 point = Vec3::Zero();
    for (int c = 0; c < 3; ++c)
      point += vein.barycentric(int(i), c) * blade.row(file.meshes[0].faces(vein.faces[i], c)).transpose();
    points.push_back(point);
  }
  return points;
}

// Analytic: a pixel of a vein lies within half the vein's width of its line, one beside it does not; where
// orders cross, the lower one is seen. Brute force over all segments, in the scene and not at rest.
TEST(LabelMaps, ShowVeinsWithinHalfTheirWidthAndNoFarther) {
  const FlatLeaf leaf;
  const LabelOptions options{0.004, 0.5};
  const LabelMaps maps = LeafLabels(leaf.file, options).maps(leaf.scene, leaf.camera, kWidth, kHeight);
  EXPECT_EQ(maps.vein_width, (std::map<int, double>{{1, 0.004}, {2, 0.002}}));
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto place = leaf.place(maps, i);
    if (!place) continue;
    int expected = 0;
    bool unsure = false;
    for (const GlbVein& vein : leaf.file.veins) {
      const std::vector<Vec3> line = vein_in(leaf.file, vein, leaf.blade());
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        nearest = std::min(nearest, distance_to_segment(*place, line[k], line[k + 1]));
      const double reach = 0.5 * maps.vein_width.at(vein.order);
      unsure = unsure || std::abs(nearest - reach) < 1e-6;
      if (nearest <= reach && (expected == 0 || vein.order < expected)) expected = vein.order;
    }
    if (unsure) continue;
    EXPECT_EQ(int(maps.vein[std::size_t(i)]), expected) << i;
    ++counts[expected];
  }
  for (const int count : counts) EXPECT_GT(count, 10);
}

// Property: the veins move with the blade. At the last frame the pixel that shows a point of a vein, or one
// next to it (pictures refine the blade a little off its faces), has its order or a lower one.
TEST(LabelMaps, KeepVeinsOnTheBladeAsItWithers) {
  const GlbFile file = sample_file();
  const Scene scene = LeafScene(file).at(4.0);
  const Camera camera = camera_of(scene);
  const LabelMaps maps = LeafLabels(file, {0.004, 1.0}).maps(scene, camera, kWidth, kHeight);
  int seen = 0;
  for (const GlbVein& vein : file.veins) {
    for (const Vec3& point : vein_in(file, vein, scene.surfaces[0].positions)) {
      const Projection q = project(camera, kAspect, point);
      const int x = int(0.5 * (1.0 + q.x) * kWidth), y = int(0.5 * (1.0 - q.y) * kHeight);
      int found = 0;
      for (int j = std::max(0, y - 1); j <= std::min(kHeight - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(kWidth - 1, x + 1); ++i) {
          const int order = maps.vein[std::size_t(j * kWidth + i)];
          if (order > 0 && (found == 0 || order < found)) found = order;
        }
      EXPECT_GE(found, 1) << x << ' ' << y;
      EXPECT_LE(found, vein.order) << x << ' ' << y;
      ++seen;
    }
  }
  EXPECT_GE(seen, 7);
}

// Analytic: keypoints are projections of the veins' ends; a board before a tip hides it, a camera that looks
// elsewhere has none inside.
TEST(LabelMaps, KnowWhichTipsAreSeen) {
  FlatLeaf leaf;
  const LeafLabels labels(leaf.file);
  const LabelMaps open = labels.maps(leaf.scene, leaf.camera, kWidth, kHeight);
  ASSERT_EQ(open.tips.size(), 2U);
  ASSERT_EQ(open.base.size(), 1U);
  EXPECT_TRUE(open.base[0].visible);
  const Points3 blade = leaf.blade();
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 tip = vein_in(leaf.file, leaf.file.veins[i], blade).back();
    const Projection q = project(leaf.camera, kAspect, tip);
    EXPECT_NEAR(open.tips[i].x, 0.5 * (1.0 + q.x) * kWidth, 1e-9);
    EXPECT_NEAR(open.tips[i].y, 0.5 * (1.0 - q.y) * kHeight, 1e-9);
    EXPECT_TRUE(open.tips[i].inside && open.tips[i].visible);

    Scene hidden = leaf.scene;
    hidden.surfaces.push_back(test::square(0.005, 0.0, Vec3::Ones(), false));
    const Vec3 before = tip + 0.1 * (leaf.camera.eye - tip).normalized();
    hidden.surfaces.back().positions.rowwise() += before.transpose();
    const LabelMaps maps = labels.maps(hidden, leaf.camera, kWidth, kHeight);
    EXPECT_TRUE(maps.tips[i].inside && !maps.tips[i].visible) << i;
    EXPECT_TRUE(maps.tips[1 - i].visible) << i;
  }
  EXPECT_EQ(open.apex, 0);  // of two in the far corners, a hair farther or the first
  Camera away = leaf.camera;
  away.forward = -away.forward;
  const LabelMaps nothing = labels.maps(leaf.scene, away, kWidth, kHeight);
  EXPECT_FALSE(nothing.tips[0].inside || nothing.tips[0].visible);
  EXPECT_EQ(nothing.area, 0);
  EXPECT_EQ(nothing.box, (std::array<int, 4>{}));
  EXPECT_NE(label_json(nothing).find("\"tips\":[[0,0,0],[0,0,0]]"), std::string::npos) << label_json(nothing);
}

// Differential: one thread against many, maps and files.
TEST(LabelMaps, AreTheSameForAnyNumberOfThreads) {
  const GlbFile file = sample_file();
  const LeafScene leaf(file);
  const Scene scene = leaf.at(3.0, file.meshes[0].water);
  const Camera camera = camera_of(scene);
  const std::string folder = testing::TempDir() + "label_threads";
  std::filesystem::create_directories(folder);
  std::vector<std::string> bytes[2];
  for (int many = 0; many < 2; ++many) {
    const ThreadLimit limit(many == 1 ? 4 : 1);
    const LabelMaps maps = LeafLabels(file).maps(scene, camera, kWidth, kHeight);
    bytes[many].push_back(label_json(maps));
    for (const std::string& path : write_label_maps(folder + "/a", maps, all_label_kinds()))
      bytes[many].push_back(read_file(path));
  }
  EXPECT_EQ(bytes[0].size(), 7U);
  EXPECT_EQ(bytes[0], bytes[1]);
  std::filesystem::remove_all(folder);
}

// Round trip: the last frame's water at the skin is what the file itself carries.
TEST(LabelMaps, TakeWaterAsTheFileHasIt) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip()), "sample");
  const Eigen::VectorXd water = skin_water(sample.leaf, sample.frames.back().water_fraction);
  ASSERT_EQ(water.size(), file.meshes[0].water.size());
  EXPECT_LT((water - file.meshes[0].water).cwiseAbs().maxCoeff(), 1e-7);
}

void expect_error(ErrorCode code, const std::string& word, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown: " << word;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(LabelMaps, RefuseWhatTheyCannotUse) {
  const GlbFile file = sample_file();
  const Scene scene = leaf_scene(file, 0.0);
  const auto with = [&](double width, double ratio) {
    return [&, width, ratio] { LeafLabels(file, {width, ratio}); };
  };
  expect_error(ErrorCode::configuration, "vein_width is -1", with(-1.0, 0.5));
  expect_error(ErrorCode::configuration, "vein_ratio is 0", with(0.0, 0.0));
  expect_error(ErrorCode::configuration, "width is 0",
               [&] { LeafLabels(file).maps(scene, camera_of(scene), 0, 10); });
  GlbFile unitless = file;
  unitless.extras = "{}";
  expect_error(ErrorCode::input, "metres", [&] { const LeafLabels labels(unitless); });
  GlbFile orders = file;
  orders.veins[1].order = 256;
  expect_error(ErrorCode::input, "vein 1 of the result has the order 256",
               [&] { const LeafLabels labels(orders); });
  Monitor stopped;
  stopped.cancelled = [] { return true; };
  expect_error(ErrorCode::interrupted, "interrupted",
               [&] { LeafLabels(file).maps(scene, camera_of(scene), 16, 16, stopped); });
  EXPECT_THROW(LeafScene(file).at(0.0, Eigen::VectorXd::Zero(3)), std::logic_error);
}

}  // namespace
}  // namespace wilt
