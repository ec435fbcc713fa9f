// Points that are drawn near a surface, and lines through them.
#include "wilt/geodesics/nearest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.hpp"
#include "wilt/core/random.hpp"
#include "wilt/geodesics/trace.hpp"

namespace wilt {
namespace {

Vec3 at(const test::Surface& surface, const SurfacePoint& point) {
  return position(surface.mesh, surface.positions, point);
}

NearestPoint nearest(const test::Surface& surface, const Vec3& place) {
  return nearest_point(surface.mesh.face_matrix(), surface.positions, place);
}

// Oracle: analytic. The nearest point of the unit square in the plane is the place clamped to it.
TEST(NearestPoint, OfASquareIsThePlaceClampedToIt) {
  const test::Surface surface = test::jittered_grid(6, 0.2, 4);
  Random random(7, "places");
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 place(random.uniform(-0.5, 1.5), random.uniform(-0.5, 1.5), random.uniform(-0.5, 0.5));
    const Vec3 expected(std::clamp(place.x(), 0.0, 1.0), std::clamp(place.y(), 0.0, 1.0), 0.0);
    const NearestPoint found = nearest(surface, place);
    EXPECT_LT((at(surface, found.point) - expected).norm(), 1e-8) << place.transpose();
    EXPECT_NEAR(found.distance, (place - expected).norm(), 1e-12);
    EXPECT_GE(found.point.barycentric.minCoeff(), 0.0);
    EXPECT_NEAR(found.point.barycentric.sum(), 1.0, 1e-15);
  }
}

// Oracle: the vertices themselves, a rounding away.
TEST(NearestPoint, OfAVertexIsExactlyThatVertex) {
  const test::Surface surface = test::jittered_grid(5, 0.2, 2);
  for (const VertexId v : surface.mesh.vertices()) {
    const NearestPoint found =
        nearest(surface, surface.positions.row(v).transpose() + Vec3(1e-14, -1e-14, 0.0));
    EXPECT_EQ(found.point.barycentric.maxCoeff(), 1.0);
    EXPECT_EQ(found.point.barycentric.cwiseAbs().sum(), 1.0);
  }
}

// Oracle: analytic, the length of the polyline in the plane; consecutive points share a face.
TEST(TraceThrough, IsThePolylineOnAFlatSurface) {
  const test::Surface surface = test::jittered_grid(9, 0.2, 3);
  Random random(1, "polylines");
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<SurfacePoint> points;
    double length = 0.0;
    for (int i = 0; i < 5; ++i) {
      points.push_back(
          nearest(surface, Vec3(random.uniform(0.02, 0.98), random.uniform(0.02, 0.98), 0.0)).point);
      if (i > 0) length += (at(surface, points[i]) - at(surface, points[i - 1])).norm();
    }
    const DrawnPath drawn = trace_through(surface.mesh, surface.positions, points);
    ASSERT_EQ(drawn.reached, 5);
    EXPECT_NEAR(drawn.path.length, length, 1e-9);
    EXPECT_LT((at(surface, drawn.path.points.back()) - at(surface, points.back())).norm(), 1e-12);
    for (std::size_t i = 1; i < drawn.path.points.size(); ++i)
      EXPECT_TRUE(common_face(surface.mesh, drawn.path.points[i - 1], drawn.path.points[i]).valid());
  }
}

// Oracle: analytic. On a quarter of a cylinder of radius 1 the straight way between two points is a helix.
TEST(TraceThrough, IsNearlyTheShortestWayOnACurvedSurface) {
  const test::Surface flat = test::grid(24, 24, 1.5, 1.0);
  const auto rolled = [](const Vec3& p) { return Vec3(std::sin(p.x()), p.y(), std::cos(p.x())); };
  const test::Surface surface = test::bent(flat, rolled);
  const std::vector<SurfacePoint> points{nearest(surface, rolled({0.1, 0.1, 0.0})).point,
                                         nearest(surface, rolled({1.3, 0.8, 0.0})).point};
  const DrawnPath drawn = trace_through(surface.mesh, surface.positions, points);
  ASSERT_EQ(drawn.reached, 2);
  EXPECT_NEAR(drawn.path.length, std::hypot(1.2, 0.7), 0.02);
}

// Oracle: by construction; a square without its middle, and a line across that.
TEST(TraceThrough, StopsWhereTheWayLeavesTheSurface) {
  const test::Surface whole = test::grid(9, 9);
  Faces kept(whole.mesh.num_faces(), 3);
  int count = 0;
  for (int f = 0; f < kept.rows(); ++f) {
    const auto corners = whole.mesh.face_matrix().row(f);
    const Vec3 middle =
        (whole.positions.row(corners[0]) + whole.positions.row(corners[1]) + whole.positions.row(corners[2]))
            .transpose() /
        3.0;
    if ((middle - Vec3(0.5, 0.5, 0.0)).cwiseAbs().maxCoeff() > 1.0 / 6.0) kept.row(count++) = corners;
  }
  const Faces around = kept.topRows(count);
  // Vertices inside the hole would belong to no face.
  std::vector<int> number(whole.positions.rows(), -1);
  Points3 positions(whole.positions.rows(), 3);
  Faces faces(count, 3);
  int vertices = 0;
  for (int i = 0; i < faces.size(); ++i) {
    const int v = around.data()[i];
    if (number[v] < 0) positions.row(number[v] = vertices++) = whole.positions.row(v);
    faces.data()[i] = number[v];
  }
  positions.conservativeResize(vertices, 3);
  const test::Surface ring{SurfaceMesh(vertices, faces), positions};
  const std::vector<SurfacePoint> points{nearest(ring, {0.1, 0.2, 0}).point,
                                         nearest(ring, {0.1, 0.5, 0}).point,
                                         nearest(ring, {0.9, 0.52, 0}).point};
  EXPECT_EQ(trace_through(ring.mesh, ring.positions, points).reached, 2);
}

}  // namespace
}  // namespace wilt
