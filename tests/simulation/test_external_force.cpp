#include <gtest/gtest.h>

#include <cmath>

#include "wilt/simulation/external_force.hpp"

namespace wilt {
namespace {

// Oracle: Table 2 of the paper.
TEST(ExternalForce, StartsFromTableTwoWithSevenTips) {
  const Points3 a = initial_tip_forces(7, "a");
  EXPECT_EQ(Vec3(a.row(3)), Vec3(.03, -.03, .03));
  EXPECT_EQ(Vec3(a.row(4)), Vec3(-.02, .01, .04));
  EXPECT_EQ(Vec3(initial_tip_forces(7, "d").row(5)), Vec3(-.04, 0, .06));
  EXPECT_EQ(Vec3(initial_tip_forces(7, "b").row(3)), Vec3(0, -.03, -.03));
  EXPECT_EQ(Vec3(initial_tip_forces(5, "d").row(2)), Vec3(0, 0, .04));
}

// Oracle: the closed form fout^0 (1 + kappa t) exp(-K_r gd).
TEST(ExternalForce, GrowsLinearlyInTimeAndFallsExponentiallyWithDistance) {
  Points3 first(2, 3);
  first << 1, 2, 3, 0, 0, 1;
  Eigen::MatrixXd distance(2, 3);
  distance << 0, 1, 2, 5, 0.5, 0;
  ExternalForce force(first, distance, 0.8, 0.3);
  for (int step = 0; step < 100; ++step) force.advance(0.1);
  const Points3 on = force.on_vertices();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double expected = (1 + 0.3 * 10.0) * (first(0, k) * std::exp(-0.8 * distance(0, i)) +
                                                  first(1, k) * std::exp(-0.8 * distance(1, i)));
      EXPECT_NEAR(on(i, k), expected, 1e-12);  // round-off of 100 additions
    }
  }
}

}  // namespace
}  // namespace wilt
