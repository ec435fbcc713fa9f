// Veins drawn by hand in place of those that were found.
#include <gtest/gtest.h>

#include <cmath>

#include "leaves.hpp"
#include "wilt/core/error.hpp"
#include "wilt/geodesics/nearest_point.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

struct Case {
  Leaf leaf = test::star_leaf(5);
  Venation found = find_venation(leaf, {});

  SurfacePoint at(double x, double y) const {
    return nearest_point(leaf.mesh.face_matrix(), leaf.positions, {x, y, 0.0}).point;
  }
  SurfacePoint tip(int i) const { return surface_point(leaf.mesh, found.tips[std::size_t(i)].vertex); }
  Vec3 place(VertexId v) const { return leaf.positions.row(v).transpose(); }
  std::vector<DrawnVein> as_found() const {
    std::vector<DrawnVein> drawn;
    for (std::size_t i = 0; i < found.veins.size(); ++i)
      drawn.push_back({found.veins[i].order, {}, static_cast<int>(i)});
    return drawn;
  }
};

// Oracle: what was found.
TEST(DrawnVeins, AsTheyWereFoundChangeNothing) {
  const Case c;
  const Venation same = with_drawn_veins(c.leaf, c.found, c.as_found());
  EXPECT_EQ(same.primary_distance, c.found.primary_distance);
  EXPECT_EQ(same.vein_distance, c.found.vein_distance);
  EXPECT_EQ(same.tip_distance, c.found.tip_distance);
}

// Oracle: analytic on a flat convex leaf: a vein drawn from the petiole by way of a point aside to the tip is
// as long as those two straight pieces, and gd is the distance to the nearer of them, within what fast
// distances err on this mesh.
TEST(DrawnVeins, GiveTheDistancesToWhatWasDrawn) {
  const Case c{test::ellipse_leaf()};
  const Vec3 o = c.place(c.leaf.petiole), aside(0.02, 0.0, 0.0), r = c.place(c.found.tips[0].vertex),
             base(0.0, 0.05, 0.0), end(-0.03, 0.06, 0.0);
  const Venation drawn = with_drawn_veins(c.leaf, c.found,
                                          {{1, {c.at(aside.x(), aside.y()), c.tip(0)}, -1},
                                           {2, {c.at(base.x(), base.y()), c.at(end.x(), end.y())}, -1}});
  ASSERT_EQ(drawn.tips.size(), 1u);
  EXPECT_EQ(drawn.tips[0].vertex, c.found.tips[0].vertex);
  EXPECT_EQ(drawn.tips[0].prominence, c.found.tips[0].prominence);
  ASSERT_EQ(drawn.veins.size(), 2u);
  EXPECT_NEAR(drawn.veins[0].path.length, (o - aside).norm() + (r - aside).norm(), 1e-6);
  EXPECT_EQ(drawn.veins[1].parent, 0);
  const auto to_segment = [](const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
  };
  for (const VertexId v : c.leaf.mesh.vertices()) {
    const Vec3 p = c.place(v);
    const double primary = std::min(to_segment(p, o, aside), to_segment(p, aside, r));
    EXPECT_NEAR(drawn.primary_distance[v], primary, 1.2e-3);
    EXPECT_NEAR(drawn.vein_distance[v], std::min(primary, to_segment(p, base, end)), 1.2e-3);
  }
}

// Oracle: the margin's order, however veins are listed, and whichever end comes first.
TEST(DrawnVeins, AreOrderedAlongTheMargin) {
  const Case c;
  const std::vector<SurfacePoint> inwards{c.tip(0), c.at(0.0, 0.0)};
  const Venation drawn =
      with_drawn_veins(c.leaf, c.found, {{1, {c.at(0.0, 0.0), c.tip(3)}, -1}, {1, {}, 2}, {1, inwards, -1}});
  ASSERT_EQ(drawn.tips.size(), 3u);
  const int order[] = {0, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(drawn.tips[i].vertex, c.found.tips[std::size_t(order[i])].vertex);
    EXPECT_EQ(drawn.veins[i].tip, int(i));
    EXPECT_EQ(drawn.tip_distance(int(i), int(drawn.tips[i].vertex)), 0.0);
    const Vec3 base = position(c.leaf.mesh, c.leaf.positions, drawn.veins[i].path.points.front());
    EXPECT_LT((base - c.place(c.leaf.petiole)).norm(), 1e-12);
  }
}

// Negative: each is refused, naming the vein.
TEST(DrawnVeins, AreRefusedWithAReason) {
  const Case c;
  const auto says = [&](const std::vector<DrawnVein>& drawn, const char* what) {
    try {
      with_drawn_veins(c.leaf, c.found, drawn);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const DrawnVein good{1, {}, 1};
  says({{2, {c.at(0, 0), c.at(0, 0.02)}, -1}}, "no vein of order 1");
  says({good, {3, {c.at(0, 0)}, -1}}, "veins[1]: its order is 3");
  says({good, {1, {c.at(0, 0), c.tip(1)}, -1}}, "same tip");
  says({good, {2, {c.tip(1), c.tip(2)}, -1}}, "leaves the blade");
  says({good, {2, {c.at(0, 0), c.at(0, 0)}, -1}}, "no length");
}

}  // namespace
}  // namespace wilt
