// A result on the table.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "output/sample_leaf.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/random.hpp"
#include "wilt/render/leaf_scene.hpp"

namespace wilt {
namespace {

GlbFile sample_file() {
  const test::Sample sample;
  return parse_glb(glb_bytes(sample.clip()), "sample");
}

double distance_error(const Points3& a, const Points3& b, int count) {
  double worst = 0.0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j)
      worst = std::max(worst, std::abs((a.row(i) - a.row(j)).norm() - (b.row(i) - b.row(j)).norm()));
  return worst;
}

// Invariance: the leaf is moved, not deformed; between two frames it is their mean. It stands on the table.
TEST(LeafScene, MovesTheLeafRigidlyOntoTheTable) {
  const GlbFile file = sample_file();
  const LeafScene leaf(file);
  ASSERT_EQ(leaf.frames(), 5);
  for (double frame = 0.0; frame <= 4.0; frame += 0.5) {
    const Scene scene = leaf.at(frame);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Surface& surface : scene.surfaces)
      lowest = std::min(lowest, surface.positions.col(2).minCoeff());
    EXPECT_NEAR(lowest, 0.0, 1e-12);
    const auto& frames = file.meshes[0].frames;
    const std::size_t k = std::size_t(frame), next = std::min<std::size_t>(k + 1, 4);
    const double t = frame - double(k);
    const Points3 expected = (1.0 - t) * frames[k] + t * frames[next];
    EXPECT_LT(distance_error(scene.surfaces[0].positions, expected, int(expected.rows())), 1e-12) << frame;
  }
  EXPECT_THROW(leaf.at(4.1), std::logic_error);
  EXPECT_THROW(leaf.at(-0.1), std::logic_error);
}

// Property: the last surface is a rim as thick as a blade, around the margin and nowhere else: every point of
// it is within its radius of the margin, and every point of the margin is in it.
TEST(LeafScene, HasARimAroundTheMargin) {
  const GlbFile file = sample_file();
  const Scene scene = leaf_scene(file, 4.0);
  const Points3 &blade = scene.surfaces.front().positions, &rim = scene.surfaces.back().positions;
  const double radius = 0.002 * 0.12;
  EXPECT_FALSE(scene.surfaces.back().leaf);
  for (int i = 0; i < rim.rows(); ++i)
    EXPECT_LT((blade.rowwise() - rim.row(i)).rowwise().norm().minCoeff(), radius) << i;
  EXPECT_EQ(scene.surfaces.front().normals.rows(), blade.rows());
  const double across = (rim.colwise().maxCoeff() - blade.colwise().maxCoeff()).cwiseAbs().maxCoeff();
  EXPECT_LT(across, radius);
}

// Round trip: maps in a file are maps on the blade, and on nothing else.
TEST(LeafScene, PutsTheMapsOnTheBlade) {
  const test::Sample sample;
  Clip with_maps = sample.clip();
  with_maps.texture = encode_png({2, 1, {255, 0, 0, 0, 255, 0}});
  with_maps.normal_texture = encode_png({1, 2, {128, 128, 255, 128, 128, 255}});
  const GlbFile file = parse_glb(glb_bytes(with_maps), "sample");
  const Scene scene = leaf_scene(file, 2.0);
  EXPECT_EQ(scene.surfaces[0].colour_map.rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0}));
  EXPECT_EQ(scene.surfaces[0].normal_map.height, 2);
  EXPECT_TRUE(scene.surfaces[1].colour_map.empty());
  GlbFile broken = file;
  broken.texture = "no picture";
  EXPECT_THROW(LeafScene{broken}, Error);
}

// Property: whatever numbers a file holds, there is a scene or an Error; the seed is fixed.
TEST(LeafScene, BearsDamagedFiles) {
  const test::Sample sample;
  const std::string bytes = glb_bytes(sample.clip());
  Random random(11, "damage");
  int shown = 0;
  for (int round = 0; round < 200; ++round) {
    std::string damaged = bytes;
    for (int i = 0; i < 3; ++i)
      damaged[bytes.size() / 2 + random.index(int(bytes.size() / 2))] = char(random.index(256));
    try {
      const GlbFile file = parse_glb(damaged, "damaged");
      validate(LeafScene(file).at(3.5));
      ++shown;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input) << round;
    }
  }
  EXPECT_GT(shown, 20);
}

}  // namespace
}  // namespace wilt
