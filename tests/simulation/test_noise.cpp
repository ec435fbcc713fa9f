#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/random.hpp"
#include "wilt/simulation/smooth_noise.hpp"

namespace wilt {
namespace {

// Oracle: zero mean, unit variance; over an area of many wavelengths the sample moments come within 10 %.
TEST(SmoothNoise, HasUnitVarianceAndZeroMean) {
  Random random(3, "test");
  Points2 points(20000, 2);
  for (int i = 0; i < points.rows(); ++i) points.row(i) << random.uniform(0, 30), random.uniform(0, 30);
  const Eigen::VectorXd field = smooth_noise(points, 0.5, 7, "a");
  EXPECT_NEAR(field.mean(), 0.0, 0.05);
  EXPECT_NEAR(field.squaredNorm() / field.size(), 1.0, 0.1);
}

// Oracle: a wave of length l changes by at most 2 pi amplitude h / l over a distance h.
TEST(SmoothNoise, IsSmoothOnTheScaleOfItsWavelength) {
  Points2 points(2, 2);
  points << 0.3, 0.4, 0.301, 0.4;
  const Eigen::VectorXd field = smooth_noise(points, 1.0, 7, "a");
  EXPECT_LT(std::abs(field[1] - field[0]), 8.0 * 2 * 3.1416 / 0.8 * 0.001);
  EXPECT_NE(field[0], smooth_noise(points, 1.0, 8, "a")[0]);
  EXPECT_NE(field[0], smooth_noise(points, 1.0, 7, "b")[0]);
}

}  // namespace
}  // namespace wilt
