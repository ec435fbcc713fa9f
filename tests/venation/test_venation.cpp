#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "venation/leaves.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

using test::ellipse_leaf;
using test::moved;
using test::star_leaf;

constexpr double kPi = std::numbers::pi;
const SecondaryVeinRule kRule;

VenationOptions with(bool secondary) {
  VenationOptions options;
  options.secondary = secondary;
  return options;
}

std::vector<int> tip_vertices(const Venation& venation) {
  std::vector<int> vertices;
  for (const Tip& tip : venation.tips) vertices.push_back(tip.vertex);
  return vertices;
}

// Oracle: construction. A lobe's tip is the point of it farthest from the petiole, which lies within a
// quarter of the lobe from its axis. Clockwise from the petiole at -y: the last lobe comes first.
TEST(FindVenation, FindsTheLobesOfAStar) {
  for (const int lobes : {3, 5, 7}) {
    const Leaf leaf = star_leaf(lobes);
    const Venation venation = find_venation(leaf, kRule, with(false));
    ASSERT_EQ(static_cast<int>(venation.tips.size()), lobes);
    for (int k = 0; k < lobes; ++k) {
      const auto tip = leaf.positions.row(venation.tips[k].vertex);
      const double angle = std::fmod(std::atan2(tip.x(), -tip.y()) + 2.0 * kPi, 2.0 * kPi);
      EXPECT_NEAR(angle, (lobes - k - 0.5) * 2.0 * kPi / lobes, 0.5 * kPi / lobes)
          << lobes << " lobes, tip " << k;
    }
  }
}

// Oracle: analytic. In a convex flat leaf everything is straight and the plane is its own embedding.
TEST(FindVenation, IsPlaneGeometryInAConvexFlatLeaf) {
  const Leaf leaf = ellipse_leaf();
  VenationOptions options = with(false);
  options.geodesics = GeodesicMethod::exact;
  const Venation venation = find_venation(leaf, kRule, options);
  ASSERT_EQ(venation.tips.size(), 1u);
  EXPECT_LT(venation.embedding_stress, 1e-20);
  const Vec3 tip = leaf.positions.row(venation.tips[0].vertex).transpose();
  EXPECT_LT((tip - Vec3(0.0, 0.1, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(venation.tips[0].d, 0.2, 1e-9);
  EXPECT_NEAR(venation.veins[0].path.length, 0.2, 1e-12);
  for (const VertexId v : leaf.mesh.vertices()) {
    const Vec3 place = leaf.positions.row(v).transpose();
    EXPECT_NEAR(venation.tip_distance(0, int(v)), (place - tip).norm(), 1e-12);
    // The petiole is at the origin of the flat leaf, its centroid on +y: the leaf frame.
    EXPECT_NEAR(venation.flat(int(v), 0), place.x(), 1e-8);
    EXPECT_NEAR(venation.flat(int(v), 1), place.y() + 0.1, 1e-8);
    // The midrib lies on the y axis; the fast march is near-exact: 1 % of the distance, and of an edge.
    EXPECT_NEAR(venation.primary_distance(int(v)), std::abs(place.x()), 0.01 * std::abs(place.x()) + 1e-4);
  }
  EXPECT_EQ(venation.primary_distance, venation.vein_distance);
}

// Oracle: the definition of the parts in terms of each other.
TEST(FindVenation, LeadsAPrimaryVeinFromThePetioleToEachTip) {
  const Leaf leaf = star_leaf(5);
  VenationOptions options;
  options.geodesics = GeodesicMethod::exact;
  const Venation venation = find_venation(leaf, kRule, options);
  for (std::size_t i = 0; i < venation.tips.size(); ++i) {
    const Vein& vein = venation.veins[i];
    EXPECT_EQ(vein.order, 1);
    EXPECT_EQ(vein.tip, static_cast<int>(i));
    const VertexId tip = venation.tips[i].vertex;
    EXPECT_EQ(position(leaf.mesh, leaf.positions, vein.path.points.front()),
              leaf.positions.row(leaf.petiole).transpose());
    EXPECT_EQ(position(leaf.mesh, leaf.positions, vein.path.points.back()),
              leaf.positions.row(tip).transpose());
    EXPECT_NEAR(vein.path.length, venation.tip_distance(static_cast<int>(i), int(leaf.petiole)), 1e-12);
    EXPECT_LT(venation.primary_distance(int(tip)), 1e-12);
  }
}

// Oracle: invariance. Exact distances move by round-off; the fast march, which measures the distance to
// veins, chooses between faces by comparisons that round-off can turn: a band of 1e-3 of the leaf of 0.2.
TEST(FindVenation, DoesNotDependOnPlaceAndUnit) {
  const Leaf leaf = star_leaf(7, 8, 56);
  VenationOptions options;
  options.geodesics = GeodesicMethod::exact;
  const Venation venation = find_venation(leaf, kRule, options);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1.0, 0.01, 1000.0}) {
    const Leaf other =
        moved(leaf, [&](const Vec3& x) { return Vec3(scale * (rotation * x + Vec3(0.3, -2, 1))); });
    const Venation same = find_venation(other, kRule, options);
    EXPECT_EQ(tip_vertices(same), tip_vertices(venation)) << scale;
    EXPECT_NEAR(same.embedding_stress, venation.embedding_stress, 1e-6 * venation.embedding_stress);
    ASSERT_EQ(same.veins.size(), venation.veins.size()) << scale;
    for (std::size_t i = 0; i < same.veins.size(); ++i)
      EXPECT_NEAR(same.veins[i].path.length, scale * venation.veins[i].path.length, 1e-7 * scale) << i;
    EXPECT_LT((same.vein_distance - scale * venation.vein_distance).cwiseAbs().maxCoeff(), 2e-4 * scale);
    EXPECT_LT((same.flat - scale * venation.flat).cwiseAbs().maxCoeff(), 1e-7 * scale);
  }
}

// Oracle: invariance. Rounding to float moves a vertex by 1e-8 of the leaf.
TEST(FindVenation, IsTheSameWhenReadBackUnderAnotherName) {
  for (const int lobes : {5, 7}) {
    const Leaf leaf = star_leaf(lobes);
    const Venation venation = find_venation(leaf, kRule, with(false));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      std::vector<int> number;
      const Venation same = find_venation(test::read_back(leaf, seed, &number), kRule, with(false));
      ASSERT_EQ(same.tips.size(), venation.tips.size()) << "seed " << seed;
      for (std::size_t i = 0; i < same.tips.size(); ++i)
        EXPECT_EQ(same.tips[i].vertex, number[venation.tips[i].vertex]) << "seed " << seed;
    }
  }
}

// Oracle: isometry. Rolled around a cylinder a leaf keeps its distances up to the mesh's second order.
TEST(FindVenation, DoesNotDependOnHowTheLeafIsRolled) {
  const Leaf leaf = star_leaf(5);
  const double radius = 0.04;
  const Leaf rolled = moved(leaf, [&](const Vec3& x) {
    return Vec3(radius * std::sin(x.x() / radius), x.y(), radius * (1.0 - std::cos(x.x() / radius)));
  });
  const Venation flat = find_venation(leaf, kRule, with(false)),
                 same = find_venation(rolled, kRule, with(false));
  EXPECT_EQ(tip_vertices(same), tip_vertices(flat));
  for (std::size_t i = 0; i < flat.tips.size(); ++i)
    EXPECT_NEAR(same.tips[i].d, flat.tips[i].d, 0.01 * flat.tips[i].d);
}

// Oracle: differential, all pairs against landmarks. They flatten by different pairs: 2 % of a leaf.
TEST(FindVenation, FindsTheSameTipsFromLandmarks) {
  const Leaf leaf = star_leaf(7);
  const Venation full = find_venation(leaf, kRule, with(false));
  VenationOptions options = with(false);
  options.full_embedding_up_to = 0;
  const Venation few = find_venation(leaf, kRule, options);
  ASSERT_EQ(few.tips.size(), full.tips.size());
  for (std::size_t i = 0; i < few.tips.size(); ++i) {
    const auto a = leaf.positions.row(few.tips[i].vertex), b = leaf.positions.row(full.tips[i].vertex);
    EXPECT_LT((a - b).norm(), 0.02 * 0.2) << i;
  }
}

// Oracle: the same bytes with one thread.
TEST(FindVenation, DoesNotDependOnTheNumberOfThreads) {
  const Leaf leaf = star_leaf(5);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return find_venation(leaf, kRule);
  };
  const Venation one = run(1), two = run(2);
  EXPECT_EQ(one.flat, two.flat);
  EXPECT_EQ(one.vein_distance, two.vein_distance);
  EXPECT_EQ(one.tip_distance, two.tip_distance);
  ASSERT_EQ(one.veins.size(), two.veins.size());
  for (std::size_t i = 0; i < one.veins.size(); ++i)
    EXPECT_EQ(one.veins[i].path.length, two.veins[i].path.length);
}

TEST(FindVenation, RefusesOptionsAndRulesOutOfRange) {
  const Leaf leaf = star_leaf(3, 6, 30);
  VenationOptions options;
  options.landmarks = 3;
  EXPECT_THROW(find_venation(leaf, kRule, options), Error);
  options = {};
  options.full_embedding_up_to = -1;
  EXPECT_THROW(find_venation(leaf, kRule, options), Error);
  options = {};
  options.peaks.window_length = 0.7;
  EXPECT_THROW(find_venation(leaf, kRule, options), Error);
  for (const SecondaryVeinRule& rule :
       {SecondaryVeinRule{0.0, 0.7, 0.24, true, 0.3}, SecondaryVeinRule{0.9, 3.1, 0.24, true, 0.3},
        SecondaryVeinRule{0.9, 0.7, 0.0, true, 0.3}, SecondaryVeinRule{0.9, 0.7, 0.24, true, 0.8}})
    EXPECT_THROW(find_venation(leaf, rule), Error);
}

TEST(FindVenation, SaysSoWhenThereIsNoTip) {
  VenationOptions options;
  options.peaks = {PeakRule::window, 60, 0.06, 0.02};  // longer than half of the margin
  try {
    find_venation(star_leaf(5), kRule, options);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("no tip"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
