#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "wilt/game/levels_of_detail.hpp"

namespace wilt {
namespace {

// A grid of 20 x 20 squares that is flat at frame 0; at frame 1 a bump of height 0.3 rises in its middle.
Moving grid_with_a_bump() {
  const test::Surface surface = test::grid(20, 20, 1.0, 1.0);
  Moving moving;
  moving.faces = surface.mesh.face_matrix();
  moving.shape = [points = surface.positions](int frame) {
    Shape shape{points, {}};
    for (int i = 0; frame == 1 && i < points.rows(); ++i) {
      const double r = (points.row(i) - Eigen::RowVector3d(0.5, 0.5, 0.0)).norm();
      shape.positions(i, 2) = 0.3 * std::exp(-40.0 * r * r);
    }
    return shape;
  };
  return moving;
}

// Oracle: analytic. A flat grid is its own outline: any level deviates by nothing but round-off.
TEST(LevelsOfDetail, KeepAFlatSheetExact) {
  const Moving moving = grid_with_a_bump();
  const std::vector<DetailLevel> levels = levels_of_detail(moving, 1, 3);
  ASSERT_EQ(levels.size(), 3U);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    EXPECT_LE(levels[k].faces.rows(), moving.faces.rows() >> (k + 1));
    EXPECT_LT(levels[k].deviation, 1e-7);
  }
}

// Oracle: property. Coarser levels miss more of the bump, and none misses all of it.
TEST(LevelsOfDetail, FollowTheWrinkledFrame) {
  const std::vector<DetailLevel> levels = levels_of_detail(grid_with_a_bump(), 2, 3);
  EXPECT_GT(levels[0].deviation, 0.0);
  EXPECT_LT(levels[0].deviation, 0.01);
  EXPECT_GT(levels[2].deviation, levels[0].deviation);
  EXPECT_LT(levels[2].deviation, 0.1);
}

}  // namespace
}  // namespace wilt
