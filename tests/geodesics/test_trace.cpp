#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geodesics/leaf_surface.hpp"
#include "wilt/core/error.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/trace.hpp"

namespace wilt {
namespace {

Vec3 end_of(const test::Surface& surface, const SurfacePath& path) {
  return position(surface.mesh, surface.positions, path.points.back());
}

void expect_connected(const test::Surface& surface, const SurfacePath& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    EXPECT_TRUE(common_face(surface.mesh, path.points[i - 1], path.points[i]).valid());
    length += (position(surface.mesh, surface.positions, path.points[i]) -
               position(surface.mesh, surface.positions, path.points[i - 1]))
                  .norm();
  }
  EXPECT_NEAR(path.length, length, 1e-12);
}

// Oracle: plane geometry, in all directions from a vertex, along edges and through vertices too.
TEST(TraceStraight, StaysStraightOnAFlatGrid) {
  const test::Surface surface = test::grid(10, 10, 2.0, 2.0);
  const VertexId centre(5 + 11 * 5);
  for (int k = 0; k < 48; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 48;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
    const SurfacePath path = trace_straight(surface.mesh, surface.positions,
                                            surface_point(surface.mesh, centre), 3.0 * direction, 0.9);
    EXPECT_NEAR(path.length, 0.9, 1e-12);
    EXPECT_LT((end_of(surface, path) - Vec3(1.0, 1.0, 0.0) - 0.9 * direction).norm(), 1e-11) << k;
    expect_connected(surface, path);
  }
}

// Oracle: the strip bent into a polygonal cylinder unrolls flat; so does the path.
TEST(TraceStraight, UnfoldsStraightOnAFoldedStrip) {
  const test::Surface flat = test::grid(12, 6, 3.0, 1.5);
  const double step = 0.25, turn = 0.5, radius = step / (2.0 * std::sin(turn / 2));
  const test::Surface bent = test::bent(flat, [&](const Vec3& p) {
    const double angle = turn * std::round(p.x() / step);
    return Vec3(radius * std::sin(angle), p.y(), radius * std::cos(angle));
  });
  const SurfacePoint start{FaceId(0), Vec3(0.5, 0.3, 0.2)};
  const Vec3 direction = Vec3(1.0, 0.4, 0.0).normalized();
  // The first column's faces hold the unrolled x axis in the direction of their lower edge.
  const Vec3 x_axis = (bent.positions.row(1) - bent.positions.row(0)).normalized();
  const Vec3 bent_direction = direction.x() * x_axis + direction.y() * Vec3::UnitY();
  const SurfacePath on_flat = trace_straight(flat.mesh, flat.positions, start, direction, 2.7);
  const SurfacePath on_bent = trace_straight(bent.mesh, bent.positions, start, bent_direction, 2.7);
  ASSERT_EQ(on_flat.points.size(), on_bent.points.size());
  EXPECT_GT(on_flat.points.size(), 12u);
  for (std::size_t i = 0; i < on_flat.points.size(); ++i) {
    EXPECT_EQ(on_flat.points[i].face, on_bent.points[i].face);
    EXPECT_LT((on_flat.points[i].barycentric - on_bent.points[i].barycentric).norm(), 1e-11) << i;
  }
  const Vec3 begin = position(flat.mesh, flat.positions, start);
  EXPECT_LT((end_of(flat, on_flat) - begin - 2.7 * direction).norm(), 1e-11);
}

// Oracle: constant curvature 1/r is a circle; the midpoint rule is of second order in the step.
TEST(TraceStraight, TurnsIntoACircle) {
  const double radius = 0.5;
  double errors[3];
  for (int level = 0; level < 3; ++level) {
    const test::Surface surface = test::grid(8 << level, 8 << level, 2.0, 2.0);
    const int side = (8 << level) + 1;
    const VertexId start(side / 4 * side + side / 2);  // (1, 0.5): the circle's lowest point
    const SurfacePath path =
        trace_straight(surface.mesh, surface.positions, surface_point(surface.mesh, start), Vec3::UnitX(),
                       0.75 * std::numbers::pi * 2.0 * radius, [&](double) { return 1.0 / radius; });
    expect_connected(surface, path);
    errors[level] = (end_of(surface, path) - Vec3(0.5, 1.0, 0.0)).norm();
  }
  EXPECT_LT(errors[0], 5e-3);
  // Edges cut steps at odd places, so the slope is taken over two refinements: 2, within 0.5.
  EXPECT_GT(std::log2(errors[0] / errors[2]) / 2.0, 1.5);
}

// Oracle: exact geodesics that meet no vertex on their way are straight, so tracing them ends at their
// target.
TEST(TraceStraight, RetracesGeodesicsOnABumpyLeaf) {
  const test::Surface surface = test::leaf(10, {.bumps = 0.1});
  const ExactGeodesics exact(surface.mesh, surface.positions);
  std::vector<VertexId> targets;
  for (const VertexId v : surface.mesh.vertices()) targets.push_back(v);
  const std::vector<SurfacePath> geodesics = exact.paths(VertexId(7), targets);
  int count = 0;
  for (const VertexId v : targets) {
    const SurfacePath& geodesic = geodesics[v];
    bool bends = geodesic.points.size() < 4;
    for (std::size_t i = 1; i + 1 < geodesic.points.size(); ++i) {
      if (geodesic.points[i].barycentric.maxCoeff() == 1.0) bends = true;
    }
    if (bends) continue;
    ++count;
    const SurfacePoint &a = geodesic.points[0], &b = geodesic.points[1];
    const Vec3 direction =
        position(surface.mesh, surface.positions, b) - position(surface.mesh, surface.positions, a);
    const SurfacePoint start = in_face(surface.mesh, a, common_face(surface.mesh, a, b));
    const SurfacePath path =
        trace_straight(surface.mesh, surface.positions, start, direction, geodesic.length);
    // Round-off of the direction grows where the surface spreads geodesics.
    EXPECT_LT((end_of(surface, path) - surface.positions.row(v).transpose()).norm(), 1e-9) << int(v);
  }
  EXPECT_GT(count, 100);
}

TEST(TraceStraight, EndsAtTheMarginAndWhereToldTo) {
  const test::Surface surface = test::grid(4, 4);
  const SurfacePoint centre = surface_point(surface.mesh, VertexId(12));
  const SurfacePath to_margin =
      trace_straight(surface.mesh, surface.positions, centre, Vec3(1.0, 0.3, 0.0), 9.0);
  EXPECT_LT((end_of(surface, to_margin) - Vec3(1.0, 0.65, 0.0)).norm(), 1e-12);
  const SurfacePath stopped = trace_straight(
      surface.mesh, surface.positions, centre, Vec3(1.0, 0.3, 0.0), 9.0, {},
      [&](const SurfacePoint& p) { return position(surface.mesh, surface.positions, p).x() > 0.7; });
  EXPECT_GT(end_of(surface, stopped).x(), 0.7);
  EXPECT_LE(end_of(surface, stopped).x(), 0.75 + 1e-12);
  const SurfacePath outwards = trace_straight(
      surface.mesh, surface.positions, surface_point(surface.mesh, VertexId(2)), Vec3(0.1, -1.0, 0.0), 1.0);
  EXPECT_EQ(outwards.points.size(), 1u);
  EXPECT_EQ(outwards.length, 0.0);
}

TEST(TraceStraight, NamesBadInput) {
  const test::Surface surface = test::grid(4, 4);
  const SurfacePoint centre = surface_point(surface.mesh, VertexId(12));
  const auto trace = [&](const SurfacePoint& start, const Vec3& direction, double length) {
    return trace_straight(surface.mesh, surface.positions, start, direction, length);
  };
  EXPECT_THROW(trace(centre, Vec3::UnitZ(), 1.0), Error);
  EXPECT_THROW(trace(centre, Vec3::Zero(), 1.0), Error);
  EXPECT_THROW(trace(centre, Vec3::UnitX(), 0.0), Error);
  EXPECT_THROW(trace(centre, Vec3::UnitX(), std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW(trace({FaceId(77), Vec3(1.0, 0.0, 0.0)}, Vec3::UnitX(), 1.0), Error);
  EXPECT_THROW(trace({FaceId(0), Vec3(0.7, 0.7, -0.4)}, Vec3::UnitX(), 1.0), Error);
}

}  // namespace
}  // namespace wilt
