// Sample points and directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "render/scenes.hpp"
#include "wilt/core/random.hpp"
#include "wilt/render/sampling.hpp"

namespace wilt {
namespace {

// Property: 16 points of a (0,2)-sequence have one in every 1/16 strip either way and in every 4 x 4, 2 x 8
// and 8 x 2 cell, in every dimension of every pixel.
TEST(Sampler, SpreadsAPixelsSamplesEvenly) {
  for (std::uint64_t pixel = 0; pixel < 50; ++pixel) {
    std::vector<Sampler> samplers;
    for (int i = 0; i < 16; ++i) samplers.emplace_back(mix_hash(pixel, 5), i, 16);
    for (int dimension = 0; dimension < 4; ++dimension) {
      std::set<int> cells[5];
      for (Sampler& sampler : samplers) {
        const Vec2 u = sampler.next();
        ASSERT_TRUE(u.minCoeff() >= 0.0 && u.maxCoeff() < 1.0);
        for (int k = 0; k < 5; ++k) {
          const int columns = 1 << k, rows = 16 >> k;
          cells[k].insert(int(u.x() * columns) * rows + int(u.y() * rows));
        }
      }
      for (const auto& cell : cells) EXPECT_EQ(cell.size(), 16u) << pixel << " " << dimension;
    }
  }
}

// Analytic: the mean cosine of a cosine-weighted direction is 2 / 3; a cap stays within its angle.
TEST(Sampling, DirectionsHaveTheirDensity) {
  double sum = 0.0;
  for (int i = 0; i < 4096; ++i) {
    Sampler sampler(9, i, 4096);
    const Vec3 d = sample_cosine(sampler.next());
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    sum += d.z();
    EXPECT_GE(sample_cap(sampler.next(), 0.1).z(), std::cos(0.1) - 1e-12);
  }
  EXPECT_NEAR(sum / 4096, 2.0 / 3.0, 1e-3);  // error of 4096 stratified points
}

}  // namespace
}  // namespace wilt
