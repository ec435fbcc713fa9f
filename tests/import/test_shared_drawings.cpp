// Real drawings made by others (WILT_SHARED); the figures were read off the pictures.
#include <gtest/gtest.h>

#include <cstdlib>

#include "import/files.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

std::filesystem::path shared_outline(const std::string& name) {
  const char* folder = std::getenv("WILT_SHARED");
  const std::filesystem::path root = folder != nullptr ? std::filesystem::path(folder)
                                                       : std::filesystem::path(WILT_SOURCE_DIR) / "../shared";
  return root / "data" / "outlines" / name;
}

// Tips of the margin: the farthest point from the petiole within 3 % of the margin to either side, at
// least 0.3 of the leaf's length away.
int lobes(const Leaf& leaf) {
  const std::vector<VertexId>& margin = margin_loop(leaf.mesh, leaf.positions);
  const int n = static_cast<int>(margin.size()), window = 3 * n / 100;
  const auto far = [&](int i) { return leaf.positions.row(margin[((i % n) + n) % n]).norm(); };
  int count = 0;
  for (int i = 0; i < n; ++i) {
    bool top = far(i) > 0.3 * leaf_length(leaf);
    for (int k = 1; k <= window && top; ++k) top = far(i) > far(i - k) && far(i) >= far(i + k);
    count += top;
  }
  return count;
}

struct Expected {
  const char* file;
  int nth;
  Vec2 petiole;  // in the drawing
  double length_mm;
  double stalk_mm;
  int least_lobes, most_lobes;  // teeth may count at the fringe of what is a lobe
};

class SharedDrawing : public ::testing::TestWithParam<Expected> {};

// Oracle: the pictures, looked at: where the stalk meets the blade, its length, and the lobes.
TEST_P(SharedDrawing, GivesALeafWithItsStalkCutOff) {
  const Expected& expected = GetParam();
  const std::filesystem::path file = shared_outline(expected.file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared drawings here; set WILT_SHARED";
  ReadOptions options;
  options.vertices = 800;
  options.nth = expected.nth;
  const Leaf leaf = read_leaf(file, options);
  const Vec2 petiole(leaf.placement.translation.x(), -leaf.placement.translation.y());
  EXPECT_LT((petiole - expected.petiole).norm(), 12.0) << petiole.transpose() << '\n' << test::notes_of(leaf);
  EXPECT_NEAR(leaf_length(leaf) * 1000, expected.length_mm, 2.0);
  ASSERT_GE(leaf.stalk.centreline.rows(), 2);
  EXPECT_NEAR(leaf.stalk.centreline.bottomRows<1>().norm() * 1000, expected.stalk_mm,
              0.15 * expected.stalk_mm);
  EXPECT_GE(lobes(leaf), expected.least_lobes);
  EXPECT_LE(lobes(leaf), expected.most_lobes);
  EXPECT_GE(smallest_angle(leaf.mesh, leaf.positions), 20.0 * 3.14159265 / 180);
}

INSTANTIATE_TEST_SUITE_P(
    Outlines, SharedDrawing,
    ::testing::Values(Expected{"leaf_01.svg", 1, {180, 129}, 115.5, 52.0, 5, 5},
                      Expected{"fall_coloured_leaf_geral_01.svg", 1, {226, 184}, 67.8, 69.0, 5, 9},
                      Expected{"fall_coloured_leaf_geral_02.svg", 1, {223, 126}, 62.4, 13.5, 3, 12},
                      Expected{"fall_coloured_leaf_geral_02.svg", 2, {239, 300}, 67.5, 11.0, 3, 12}));

}  // namespace
}  // namespace wilt
