#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "wilt/output/tube.hpp"

namespace wilt {
namespace {

// A quarter of a circle of radius 1 in the plane x = 0.
Points3 arc(int count) {
  Points3 points(count, 3);
  for (int k = 0; k < count; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / (count - 1);
    points.row(k) << 0.0, -std::sin(angle), std::cos(angle);
  }
  return points;
}

// Oracle: analytic, the volume of a prism over a regular polygon: (n / 2) r^2 sin(2 pi / n) h.
TEST(Tube, HasTheVolumeOfAPrismWhenStraightAndFacesOutwards) {
  Points3 line(3, 3);
  line << 0, 0, 0, 0, -0.5, 0, 0, -2, 0;
  const Tube prism = tube(line, {0.3, 0.3, 0.3}, 7, tube_reference(line));
  double volume = 0.0;
  for (int f = 0; f < prism.faces.rows(); ++f) {
    const Vec3 a = prism.positions.row(prism.faces(f, 0)), b = prism.positions.row(prism.faces(f, 1)),
               c = prism.positions.row(prism.faces(f, 2));
    volume += a.dot(b.cross(c)) / 6.0;
    const Vec3 mean = (prism.normals.row(prism.faces(f, 0)) + prism.normals.row(prism.faces(f, 1)) +
                       prism.normals.row(prism.faces(f, 2)))
                          .transpose();
    EXPECT_GT((b - a).cross(c - a).dot(mean), 0.0) << "face " << f;
  }
  EXPECT_NEAR(volume, 3.5 * 0.09 * std::sin(2.0 * std::numbers::pi / 7.0) * 2.0, 1e-14);  // round-off
}

// Oracle: invariant. Every edge of a ring's corners, with the caps welded to the rings, has two faces of
// opposite sense.
TEST(Tube, IsClosedOnceTheCapsAreWeldedToTheRings) {
  const Points3 line = arc(4);
  const int sides = 5;
  const Tube closed = tube(line, {0.1, 0.1, 0.1, 0.1}, sides, tube_reference(line));
  const auto welded = [&](int v) {
    for (int w = 0; w < v; ++w)
      if (closed.positions.row(w) == closed.positions.row(v)) return w;
    return v;
  };
  std::set<std::pair<int, int>> halfedges;
  for (int f = 0; f < closed.faces.rows(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const auto edge = std::pair(welded(closed.faces(f, c)), welded(closed.faces(f, (c + 1) % 3)));
      EXPECT_TRUE(halfedges.insert(edge).second) << "twice the same direction at face " << f;
    }
  }
  for (const auto& [from, to] : halfedges) EXPECT_TRUE(halfedges.count({to, from})) << from << " " << to;
}

// Oracle: analytic. Parallel transport in a plane leaves the vector across the plane alone.
TEST(Tube, DoesNotTwistAlongAPlaneCurve) {
  const Points3 line = arc(9);
  const int sides = 8;
  const Tube bow = tube(line, std::vector<double>(9, 0.05), sides, Vec3::UnitX());
  for (int k = 0; k < 9; ++k)
    EXPECT_LT((bow.normals.row(k * sides).transpose() - Vec3::UnitX()).norm(), 1e-12) << "ring " << k;
}

// Oracle: invariance. A rigid motion of centreline and reference moves every corner with it.
TEST(Tube, MovesWithARigidMotion) {
  const Points3 line = arc(6);
  const std::vector<double> radii{0.1, 0.09, 0.08, 0.07, 0.06, 0.05};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vec3 reference = tube_reference(line);
  const Tube here = tube(line, radii, 6, reference);
  const Tube there = tube(line * turn.transpose(), radii, 6, turn * reference);
  EXPECT_LT((there.positions - here.positions * turn.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((there.normals - here.normals * turn.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

// Oracle: analytic; two points at one place have no direction of their own.
TEST(Tube, BearsRepeatedPoints) {
  Points3 line(4, 3);
  line << 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0;
  const Tube stalk = tube(line, {0.1, 0.1, 0.1, 0.1}, 4, tube_reference(line));
  EXPECT_LT((stalk.normals.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-14);
}

// Oracle: negative.
TEST(Tube, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(tube(arc(3), {0.1, 0.1}, 5, Vec3::UnitX()), std::logic_error);
  EXPECT_THROW(tube(arc(3).topRows(1), {0.1}, 5, Vec3::UnitX()), std::logic_error);
}

}  // namespace
}  // namespace wilt
