// The baked normal map.
#include "wilt/simulation/leaf_relief.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/simulation/uv_raster.hpp"

namespace wilt {
namespace {

struct Case {
  Leaf leaf;
  Venation venation;
};

Case make_case(const std::string& name) {
  Case c{make_leaf(name, 600, 1), {}};
  c.venation = find_venation(c.leaf, species(name).secondary);
  return c;
}

Image bake(const Case& c, double dryness, int size) {
  const auto texels = BladeTexels::make(c.leaf, c.venation, size);
  if (!texels) return {};
  return leaf_relief(*texels, Eigen::VectorXd::Constant(c.leaf.positions.rows(), dryness));
}

Vec3 normal_at(const Image& map, const Vec2& uv) {
  const std::uint8_t* p = map.pixel(int(uv.x() * map.width), int(uv.y() * map.height));
  return Vec3(p[0], p[1], p[2]) / 127.5 - Vec3::Ones();
}

// RMS slope over the covered texels; every normal is of unit length within the rounding of 8 bits.
double roughness(const Case& c, const Image& map) {
  const auto raster = uv_raster(c.leaf.skin, map.width);
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (raster->face[std::size_t(y) * map.width + x] < 0) continue;
      const Vec3 n = normal_at(map, {(x + 0.5) / map.width, (y + 0.5) / map.height});
      EXPECT_NEAR(n.norm(), 1.0, 0.01);
      EXPECT_GT(n.z(), 0.0);
      sum += n.head<2>().squaredNorm() / (n.z() * n.z());
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// Oracle: on either flank of a ridge the normal leans away from it. The willow's midrib runs up the middle,
// in the picture as on the leaf, so x of the map is to the right.
TEST(LeafRelief, StandsUpAlongTheMidrib) {
  const Case c = make_case("willow");
  const Image map = bake(c, 0.5, 1024);
  const auto& path = c.venation.veins.front().path.points;
  double left = 0.0, right = 0.0;
  int count = 0;
  for (std::size_t i = path.size() / 8; i < path.size() / 2; ++i, ++count) {
    Vec2 uv = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
      uv += path[i].barycentric[k] * c.leaf.skin.uv.row(c.leaf.skin.faces(int(path[i].face), k)).transpose();
    const Vec2 aside(0.0025, 0.0);
    left += normal_at(map, uv - aside).x(), right += normal_at(map, uv + aside).x();
  }
  ASSERT_GT(count, 5);
  EXPECT_LT(left / count, -0.2);
  EXPECT_GT(right / count, 0.2);
}

// Property: drying roughens; the slopes are what a shaded picture can bear.
TEST(LeafRelief, IsRougherTheDrier) {
  const Case c = make_case("tilia");
  const double fresh = roughness(c, bake(c, 0.0, 512)), half = roughness(c, bake(c, 0.5, 512)),
               dry = roughness(c, bake(c, 1.0, 512));
  EXPECT_GT(fresh, 0.05);
  EXPECT_GT(half, 1.1 * fresh);
  EXPECT_GT(dry, 1.1 * half);
  EXPECT_LT(dry, 0.8);
}

// Convergence: the slopes are of the leaf, not of the texels: a finer map is about as rough. The band of 20 %
// is for the areoles, whose walls are two texels wide at 1024.
TEST(LeafRelief, HasTheSlopesOfTheLeafAtAnySize) {
  const Case c = make_case("ivy");
  EXPECT_NEAR(roughness(c, bake(c, 0.8, 2048)) / roughness(c, bake(c, 0.8, 1024)), 1.0, 0.2);
}

// Oracle: the bytes on one thread.
TEST(LeafRelief, GivesTheSameBytesOnAnyNumberOfThreads) {
  const Case c = make_case("grape");
  Image one;
  {
    const ThreadLimit limit(1);
    one = bake(c, 0.8, 200);
  }
  const ThreadLimit limit(3);
  EXPECT_EQ(bake(c, 0.8, 200).rgb, one.rgb);
  EXPECT_TRUE(bake(c, 0.8, 0).empty());
}

}  // namespace
}  // namespace wilt
