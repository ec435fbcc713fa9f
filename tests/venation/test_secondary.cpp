#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "venation/leaves.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

using test::ellipse_leaf;
using test::star_leaf;

/// From landmarks: quick, and the tips of these leaves are plain.
Venation venation_of(const Leaf& leaf, const SecondaryVeinRule& rule) {
  VenationOptions options;
  options.full_embedding_up_to = 0;
  options.landmarks = 20;
  return find_venation(leaf, rule, options);
}

/// The vein in the plane, without stretches of no length.
std::vector<Vec2> polyline(const Leaf& leaf, const Vein& vein) {
  std::vector<Vec2> points;
  for (const SurfacePoint& point : vein.path.points) {
    const Vec2 place = position(leaf.mesh, leaf.positions, point).head<2>();
    if (points.empty() || (place - points.back()).norm() > 1e-9) points.push_back(place);
  }
  return points;
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
}

bool cross(const std::vector<Vec2>& a, const std::vector<Vec2>& b, std::size_t skip_first) {
  for (std::size_t i = 1 + skip_first; i < a.size(); ++i) {
    for (std::size_t j = 1 + skip_first; j < b.size(); ++j) {
      if (side_of(a[i - 1], a[i], b[j - 1]) * side_of(a[i - 1], a[i], b[j]) < 0.0 &&
          side_of(b[j - 1], b[j], a[i - 1]) * side_of(b[j - 1], b[j], a[i]) < 0.0)
        return true;
    }
  }
  return false;
}

double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// Oracle: the rule, by plane geometry. The ellipse's midrib is the y axis from -0.1 to 0.1.
TEST(SecondaryVeins, LeaveTheMidribByTheRule) {
  const Leaf leaf = ellipse_leaf(14, 80);
  for (const bool alternate : {true, false}) {
    const SecondaryVeinRule rule{1.0, 0.6, 0.2, alternate, 0.3};
    const Venation venation = venation_of(leaf, rule);
    const double spacing = 0.2 * std::sqrt(surface_area(leaf.mesh, leaf.positions));
    std::vector<double> left, right;
    for (const Vein& vein : venation.veins) {
      if (vein.order == 1) continue;
      EXPECT_EQ(vein.parent, 0);
      const std::vector<Vec2> points = polyline(leaf, vein);
      EXPECT_NEAR(points.front().x(), 0.0, 1e-9);
      const double s = points.front().y() + 0.1;
      const double out = points[1].x() > 0.0 ? -1.0 : 1.0;  // right of the midrib turns clockwise
      (out > 0.0 ? left : right).push_back(s);
      // The first stretch may be cut short, so it has turned by little.
      EXPECT_NEAR(out * angle_between(Vec2::UnitY(), points[1] - points[0]), 1.0 - 0.4 * s / 0.2, 0.06) << s;
      const double turned = angle_between(points[1] - points[0], points.back() - points[points.size() - 2]);
      EXPECT_NEAR(-out * turned, 0.3, 0.09) << "bends towards the tip";
      EXPECT_LE(vein.path.length, 0.2 - s + 1e-12);
    }
    for (const std::vector<double>& side : {left, right}) {
      ASSERT_GE(side.size(), 4u);
      EXPECT_GE(side.front(), 0.12 * 0.2 - 1e-9);
      for (std::size_t i = 1; i < side.size(); ++i) EXPECT_NEAR(side[i] - side[i - 1], spacing, 1e-9);
    }
    EXPECT_NEAR(right.front() - left.front(), alternate ? 0.5 * spacing : 0.0, 1e-9);
  }
}

// Oracle: plane geometry. A vein stops short of the margin, by 4 % of its way and the stop's step of an edge.
TEST(SecondaryVeins, EndJustBeforeTheMargin) {
  const Leaf leaf = ellipse_leaf(14, 80);
  const Venation venation = venation_of(leaf, {1.0, 0.9, 0.25, false, 0.2});
  int long_ones = 0;
  for (const Vein& vein : venation.veins) {
    if (vein.order == 1) continue;
    const Vec2 end = polyline(leaf, vein).back();
    const double level = std::hypot(end.x() / 0.05, end.y() / 0.1);  // 1 on the margin
    EXPECT_LT(level, 1.0);
    long_ones += level > 0.85;
  }
  EXPECT_GE(long_ones, 6);
}

// Oracle: brute force over all pairs of segments.
TEST(SecondaryVeins, CrossNoOtherVein) {
  for (const int lobes : {3, 5, 7}) {
    const Leaf leaf = star_leaf(lobes);
    for (const double curvature : {-0.5, 0.0, 0.4, 0.7}) {
      const Venation venation = venation_of(leaf, {0.9, 0.7, 0.15, true, curvature});
      EXPECT_GT(venation.veins.size(), 3u * lobes);
      for (std::size_t i = 0; i < venation.veins.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Vein &a = venation.veins[i], &b = venation.veins[j];
          if (b.order == 1 && a.order == 1) continue;  // they part at the petiole
          const bool family = a.parent == static_cast<int>(j) || a.parent == b.parent;
          EXPECT_FALSE(cross(polyline(leaf, a), polyline(leaf, b), family ? 1 : 0))
              << lobes << " lobes, curvature " << curvature << ", veins " << i << " and " << j;
        }
      }
    }
  }
}

// Oracle: the definition. No farther than the primary veins; zero where a vein passes.
TEST(SecondaryVeins, BringEveryVertexNearerToAVein) {
  const Leaf leaf = star_leaf(5);
  const Venation venation = venation_of(leaf, {});
  EXPECT_LE((venation.vein_distance - venation.primary_distance).maxCoeff(), 0.0);
  EXPECT_LT(venation.vein_distance.mean(), 0.7 * venation.primary_distance.mean());
  EXPECT_GE(venation.vein_distance.minCoeff(), 0.0);
}

}  // namespace
}  // namespace wilt
