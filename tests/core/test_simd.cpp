#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "wilt/core/simd.hpp"
#include "wilt/core/simd_atan2.hpp"

namespace wilt {
namespace {

TEST(Simd, gathersThePointsOfItsIndices) {
  std::vector<Point4> points;
  for (int i = 0; i < 20; ++i) points.push_back({Double4{1.0 * i, 100.0 + i, 200.0 + i, -1.0}});
  const int indices[] = {3, 0, 19, 7, 7, 12, 1, 5};
  const Point8 p = simd::gather(points.data(), indices);
  for (int l = 0; l < simd::kLanes; ++l) {
    EXPECT_EQ(p.x[l], indices[l]);
    EXPECT_EQ(p.y[l], 100 + indices[l]);
    EXPECT_EQ(p.z[l], 200 + indices[l]);
  }
}

TEST(Simd, storesPointsAsItLoadsThem) {
  std::vector<Point4> points(8), copy(8);
  for (int i = 0; i < 8; ++i) points[i].xyz = Double4{1.0 * i, 10.0 + i, 20.0 + i, 0.0};
  simd::store_points(copy.data(), simd::load_points(points.data()));
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(copy[i].xyz[k], points[i].xyz[k]);
  }
}

// Code for AVX-512 moves whole cache lines; an array that is not aligned to them makes it crash.
TEST(Simd, arraysAreAligned) {
  for (std::size_t n = 1; n < 20; ++n) {
    const std::vector<Number8> numbers(n);
    const std::vector<Point8> points(n);
    const std::vector<Point4> gathered(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(points.data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(gathered.data()) % 32, 0u);
  }
}

TEST(Simd, loadsWhereNothingIsAligned) {
  const double numbers[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  double copy[9] = {};
  simd::store(copy + 1, simd::load(numbers + 1));
  for (int i = 1; i < 9; ++i) EXPECT_EQ(copy[i], numbers[i]);
}

TEST(Simd, rootsAndSumsAsOneByOne) {
  const Double8 v = {1, 2, 3, 4, 5, 6, 7, 1e300};
  const Double8 roots = simd::sqrt(v);
  for (int l = 0; l < simd::kLanes; ++l) EXPECT_EQ(roots[l], std::sqrt(v[l]));
  EXPECT_EQ(simd::sum(Double8{1, 2, 4, 8, 16, 32, 64, 128}), 255.0);
}

// Oracle: std::atan2, on a circle that passes through all axes and diagonals, with radii and flat angles of
// all sizes; 4 units in the last place.
TEST(Simd, measuresAnglesAsTheStandardLibraryDoes) {
  std::vector<double> ys, xs;
  const auto add = [&](double y, double x) {
    ys.push_back(y);
    xs.push_back(x);
  };
  for (int k = -3600; k <= 3600; ++k) {
    const double angle = k * (M_PI / 3600.0), radius = std::pow(10.0, k % 90);
    add(radius * std::sin(angle), radius * std::cos(angle));
  }
  for (int k = 0; k < 200; ++k) {
    const double tiny = std::pow(0.5, k);
    for (const double sign : {-1.0, 1.0}) {
      add(sign * tiny, 1.0);
      add(sign * tiny, -1.0);
      add(1.0, sign * tiny);
    }
  }
  for (const double y : {-1.0, 0.0, 1.0}) {
    for (const double x : {-1.0, 0.0, 1.0}) add(y, x);
  }
  while (ys.size() % simd::kLanes != 0) add(1.0, 1.0);
  for (std::size_t k = 0; k < ys.size(); k += simd::kLanes) {
    const Double8 angles = simd::atan2(simd::load(ys.data() + k), simd::load(xs.data() + k));
    for (int l = 0; l < simd::kLanes; ++l) {
      const double expected = std::atan2(ys[k + l], xs[k + l]);
      ASSERT_NEAR(angles[l], expected, 4 * 2.2e-16 * std::abs(expected)) << ys[k + l] << " " << xs[k + l];
    }
  }
}

}  // namespace
}  // namespace wilt
