// Sample points, and the search for the nearest vein.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "render/scenes.hpp"
#include "wilt/core/random.hpp"
#include "wilt/render/rays.hpp"
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

// Differential: every segment, one by one.
TEST(World, FindsTheHighestVeinOfAll) {
  Random random(17, "veins");
  Scene scene{{test::square(1.0, 0.0, Vec3::Constant(0.5), true)}, {}};
  for (int i = 0; i < 12; ++i) {
    VeinLine vein;
    vein.positions = Points3::Zero(4, 3);
    for (int k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis) vein.positions(k, axis) = random.uniform(-0.7, 0.7);
    vein.radius = random.uniform(0.02, 0.1);
    scene.veins.push_back(vein);
  }
  const World world(scene);
  int found = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 p(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    double nearest = 2.5;
    int expected = -1;
    for (int i = 0; i < 12; ++i) {
      const VeinLine& vein = world.scene().veins[i];
      for (int k = 0; k < 3; ++k) {
        const Vec3 a = vein.positions.row(k).transpose(), ab = vein.positions.row(k + 1).transpose() - a;
        const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        const double radius = vein.radius * (1.0 - (2.0 / 3.0) * (k + t) / 3.0);
        if ((p - a - t * ab).norm() / radius < nearest)
          nearest = (p - a - t * ab).norm() / radius, expected = i;
      }
    }
    const auto hit = world.nearest_vein(p, 2.5);
    ASSERT_EQ(hit ? hit->vein : -1, expected) << trial;
    if (!hit) continue;
    ++found;
    EXPECT_NEAR(hit->distance / hit->radius, nearest, 1e-9);
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace wilt
