#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "wilt/core/simd.hpp"

namespace wilt {
namespace {

TEST(Simd, gathersThePointsOfItsIndices) {
  std::vector<Double4> points;
  for (int i = 0; i < 20; ++i) points.push_back(Double4{1.0 * i, 100.0 + i, 200.0 + i, -1.0});
  const int indices[] = {3, 0, 19, 7, 7, 12, 1, 5};
  const Point8 p = simd::gather(points.data(), indices);
  for (int l = 0; l < simd::kLanes; ++l) {
    EXPECT_EQ(p.x[l], indices[l]);
    EXPECT_EQ(p.y[l], 100 + indices[l]);
    EXPECT_EQ(p.z[l], 200 + indices[l]);
  }
}

TEST(Simd, storesPointsAsItLoadsThem) {
  std::vector<Double4> points(8), copy(8);
  for (int i = 0; i < 8; ++i) points[i] = Double4{1.0 * i, 10.0 + i, 20.0 + i, 0.0};
  simd::store_points(copy.data(), simd::load_points(points.data()));
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(copy[i][k], points[i][k]);
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

}  // namespace
}  // namespace wilt
