#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/random.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

// Finite difference of the value, step 1e-6: error about 1e-9.
TEST(FineNetwork, GradientsOfItsPartsAreThoseOfTheValues) {
  Random random(13, "noise");
  for (int trial = 0; trial < 200; ++trial) {
    const Vec2 p(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
    const double h = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec2 step = h * Vec2::Unit(axis);
      EXPECT_NEAR(value_noise(p, 3).gradient[axis],
                  (value_noise(p + step, 3).value - value_noise(p - step, 3).value) / (2 * h), 1e-6);
      const double difference = cell_wall(p + step, 3).distance - cell_wall(p - step, 3).distance;
      if (std::abs(difference) < 10 * h) {  // else another pair of cells on either side
        EXPECT_NEAR(cell_wall(p, 3).gradient[axis], difference / (2 * h), 1e-3);
      }
    }
    EXPECT_LE(std::abs(value_noise(p, 3).value), 1.0);
    EXPECT_GE(cell_wall(p, 3).distance, 0.0);
  }
}

// Oracle: the formula of a wall's profile, (1 - x^2)^2 of height 1; and cells that are closed: along a line
// that is ten cells long, about ten walls or more are crossed.
TEST(FineNetwork, IsMadeOfWallsAroundCells) {
  int walls = 0;
  bool on_wall = false;
  for (int i = 0; i < 20000; ++i) {
    const FineNetwork network = fine_network({0.05 + i * (10.0 / 22.0) / 20000, 0.31}, 7);
    for (const double height : {network.tertiary, network.quaternary, network.areole}) {
      EXPECT_GE(height, 0.0);
      EXPECT_LE(height, 1.0);
    }
    if ((network.tertiary > 0.0) != on_wall) walls += on_wall = !on_wall;
  }
  EXPECT_GE(walls, 8);
  EXPECT_LE(walls, 30);
}

// Oracle: invariance; another seed gives another network, the same one the same.
TEST(FineNetwork, DependsOnPlaceAndSeedAlone) {
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec2 p(0.01 * i, 0.37);
    EXPECT_EQ(fine_network(p, 3).tertiary, fine_network(p, 3).tertiary);
    differ += fine_network(p, 3).tertiary != fine_network(p, 4).tertiary;
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace wilt
