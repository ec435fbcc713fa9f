#include "wilt/simulation/fine_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wilt/core/random.hpp"
#include "wilt/core/types.hpp"

namespace wilt {
namespace {

Place16 everywhere(double x, double y) {
  return {Float16{} + static_cast<float>(x), Float16{} + static_cast<float>(y)};
}

double noise_at(double x, double y, std::uint64_t seed) {
  return value_noise(everywhere(x, y), seed)[5];
}

// Oracle: the formula in double, its values on the integers read from the noise itself. Error of float.
TEST(ValueNoise, IsCubicBetweenItsValuesOnTheIntegers) {
  Random random(13, "noise");
  const auto rise = [](double t) { return t * t * (3.0 - 2.0 * t); };
  for (int trial = 0; trial < 200; ++trial) {
    const double x = random.uniform(-9.0, 9.0), y = random.uniform(-9.0, 9.0);
    const double i = std::floor(x), j = std::floor(y), s = rise(x - i), t = rise(y - j);
    const double bottom = (1 - s) * noise_at(i, j, 3) + s * noise_at(i + 1, j, 3),
                 top = (1 - s) * noise_at(i, j + 1, 3) + s * noise_at(i + 1, j + 1, 3);
    EXPECT_NEAR(noise_at(x, y, 3), (1 - t) * bottom + t * top, 1e-5) << x << " " << y;
    EXPECT_LE(std::abs(noise_at(x, y, 3)), 1.0);
  }
}

// Oracle: the moments of numbers that are even in [-1, 1] and independent, of 90,000 of them.
TEST(ValueNoise, IsEvenAndIndependentOnTheIntegers) {
  double mean = 0.0, square = 0.0, beside = 0.0, above = 0.0;
  constexpr int kSide = 300;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double value = noise_at(i, j, 8);
      mean += value, square += value * value;
      beside += value * noise_at(i + 1, j, 8), above += value * noise_at(i, j + 1, 8);
    }
  }
  constexpr double kCount = kSide * kSide;
  EXPECT_NEAR(mean / kCount, 0.0, 0.01);
  EXPECT_NEAR(square / kCount, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(beside / kCount, 0.0, 0.01);
  EXPECT_NEAR(above / kCount, 0.0, 0.01);
}

// Differential: the two nearest of all points of the nine cells by sorting, in double.
TEST(WallDistance, IsToTheLineBetweenTheTwoNearestPoints) {
  Random random(14, "walls");
  for (int trial = 0; trial < 200; ++trial) {
    const Vec2 p(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
    const int i = static_cast<int>(std::floor(p.x())), j = static_cast<int>(std::floor(p.y()));
    const Lattice16 lattice(Int16{} + i, Int16{} + j, 3);
    std::vector<Vec2> points;
    for (int up = -1; up <= 1; ++up) {
      for (int right = -1; right <= 1; ++right) {
        const unsigned word = lattice.word(right, up)[0];
        points.emplace_back(i + right + (word & 0xffff) / 65536.0, j + up + (word >> 16) / 65536.0);
      }
    }
    std::sort(points.begin(), points.end(),
              [&](const Vec2& a, const Vec2& b) { return (a - p).norm() < (b - p).norm(); });
    const Vec2 across = (points[1] - points[0]).normalized();
    EXPECT_NEAR(wall_distance(everywhere(p.x(), p.y()), 3)[7],
                (0.5 * (points[0] + points[1]) - p).dot(across), 1e-4)
        << p.transpose();
  }
}

// Oracle: the formula of a wall's profile, (1 - x^2)^2 of height 1; and cells that are closed: along a line
// that is ten cells long, about ten walls or more are crossed.
TEST(FineNetwork, IsMadeOfWallsAroundCells) {
  int walls = 0;
  bool on_wall = false;
  for (int i = 0; i < 20000; ++i) {
    const FineNetwork16 network = fine_network(everywhere(0.05 + i * (10.0 / 22.0) / 20000, 0.31), 7);
    for (const float height : {network.tertiary[0], network.quaternary[0], network.areole[0]}) {
      EXPECT_GE(height, 0.0F);
      EXPECT_LE(height, 1.0F);
    }
    if ((network.tertiary[0] > 0.0F) != on_wall) walls += on_wall = !on_wall;
  }
  EXPECT_GE(walls, 8);
  EXPECT_LE(walls, 30);
}

// Oracle: invariance; another seed gives another network, another lane the same.
TEST(FineNetwork, DependsOnPlaceAndSeedAlone) {
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    const Place16 p = everywhere(0.01 * i, 0.37);
    EXPECT_EQ(fine_network(p, 3).tertiary[0], fine_network(p, 3).tertiary[15]);
    differ += fine_network(p, 3).tertiary[0] != fine_network(p, 4).tertiary[0];
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace wilt
