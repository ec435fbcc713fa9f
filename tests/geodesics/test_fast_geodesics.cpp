#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

#include "geodesics/leaf_surface.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"

namespace wilt {
namespace {

// Oracle: on a flat convex domain the unfolded image is the source itself, whatever the triangles.
TEST(FastGeodesics, EqualEuclidOnAFlatConvexMesh) {
  const test::Surface surface = test::grid(12, 9, 1.2, 0.9);
  const FastGeodesics geodesics(surface.mesh, surface.positions);
  for (const VertexId source : surface.mesh.vertices()) {
    const Eigen::VectorXd euclid =
        (surface.positions.rowwise() - surface.positions.row(source)).rowwise().norm();
    // Directions are in single precision, and a ray may miss an edge by 1e-6 of it: errors of the second
    // order.
    EXPECT_LT((geodesics.distances(source) - euclid).cwiseAbs().maxCoeff(), 1e-8) << int(source);
  }
}

// Differential: against our exact solver, itself checked against CGAL. Bands: what the method promises.
TEST(FastGeodesics, AreNearTheExactOnes) {
  for (const bool hole : {false, true}) {
    const test::Surface surface = test::leaf(18, {.depth = 0.15, .bumps = 0.02, .hole = hole, .seed = 3});
    const ExactGeodesics exact(surface.mesh, surface.positions);
    const FastGeodesics fast(surface.mesh, surface.positions);
    const int n = surface.mesh.num_vertices();
    double sum = 0.0, worst = 0.0;
    int count = 0;
    for (int source = 0; source < n; source += n / 20) {
      const Eigen::VectorXd a = exact.distances(VertexId(source)), b = fast.distances(VertexId(source));
      for (int v = 0; v < n; ++v) {
        if (v == source) continue;
        const double error = std::abs(a[v] - b[v]) / a[v];
        sum += error;
        worst = std::max(worst, error);
        ++count;
      }
    }
    std::printf("%d vertices: relative error mean %.2e, max %.2e\n", n, sum / count, worst);
    EXPECT_LT(sum / count, 2e-4);
    EXPECT_LT(worst, 0.04);
  }
}

// Oracle: the distance to a segment that crosses a flat grid, which is convex. Directions in single
// precision.
TEST(FastGeodesics, MeasureToAPolylineOnAFlatMesh) {
  const test::Surface surface = test::grid(12, 12);
  const ExactGeodesics exact(surface.mesh, surface.positions);
  const FastGeodesics fast(surface.mesh, surface.positions);
  const VertexId from(2 + 13 * 3), to(10 + 13 * 8);
  const std::vector<SurfacePath> paths = exact.paths(from, {to});
  const Eigen::VectorXd distances = fast.distances(paths);
  const Vec3 a = surface.positions.row(from), b = surface.positions.row(to);
  for (const VertexId v : surface.mesh.vertices()) {
    const Vec3 p = surface.positions.row(v);
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    EXPECT_NEAR(distances[v], (p - a - t * (b - a)).norm(), 1e-7) << int(v);
  }
}

// Oracle: several polylines, the nearest counts; a polyline of one point is that point; none is infinitely
// far.
TEST(FastGeodesics, TakeTheNearestPolyline) {
  const test::Surface surface = test::grid(10, 10);
  const FastGeodesics fast(surface.mesh, surface.positions);
  const VertexId a(0), b(60), c(120);
  std::vector<SurfacePath> paths;
  EXPECT_TRUE(std::isinf(fast.distances(paths)[7]));
  for (const VertexId v : {a, b, c}) paths.push_back({{surface_point(surface.mesh, v)}, 0.0});
  const Eigen::VectorXd distances = fast.distances(paths);
  for (const VertexId v : surface.mesh.vertices()) {
    double nearest = 1e9;
    for (const VertexId s : {a, b, c})
      nearest = std::min(nearest, (surface.positions.row(v) - surface.positions.row(s)).norm());
    // Where two fronts meet inside a face, the segment between their images cuts the corner: half a cell.
    EXPECT_NEAR(distances[v], nearest, 0.05) << int(v);
  }
}

TEST(AllPairs, AreSymmetricAndWhatTheSourcesGive) {
  const test::Surface surface = test::leaf(5, {.bumps = 0.1});
  for (const GeodesicMethod method : {GeodesicMethod::fast, GeodesicMethod::exact}) {
    const Eigen::MatrixXd d = all_pairs(surface.mesh, surface.positions, method);
    const std::vector<VertexId> sources{VertexId(4), VertexId(50)};
    const Eigen::MatrixXd columns = geodesic_distances(surface.mesh, surface.positions, sources, method);
    EXPECT_EQ(d, d.transpose());
    EXPECT_EQ(d.diagonal().norm(), 0.0);
    EXPECT_EQ(d(4, 50), 0.5 * (columns(50, 0) + columns(4, 1)));
  }
}

// Differential: one thread against two, to the byte.
TEST(AllPairs, AreTheSameOnAnyNumberOfThreads) {
  const test::Surface surface = test::leaf(6, {.bumps = 0.1});
  for (const GeodesicMethod method : {GeodesicMethod::fast, GeodesicMethod::exact}) {
    Eigen::MatrixXd one, two;
    {
      const ThreadLimit limit(1);
      one = all_pairs(surface.mesh, surface.positions, method);
    }
    {
      const ThreadLimit limit(2);
      two = all_pairs(surface.mesh, surface.positions, method);
    }
    EXPECT_EQ(one, two);
  }
}

TEST(AllPairs, ReportProgressAndStopWhenAsked) {
  const test::Surface surface = test::leaf(9);
  std::vector<double> fractions;
  Monitor monitor;
  monitor.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast, monitor);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  monitor.cancelled = [&] { return fractions.size() > 6; };
  try {
    all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast, monitor);
    FAIL() << "was not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
  }
}

TEST(FastGeodesics, NameBadInput) {
  const test::Surface surface = test::grid(4, 4);
  const FastGeodesics fast(surface.mesh, surface.positions);
  EXPECT_THROW(fast.distances(VertexId(25)), Error);
  std::vector<SurfacePath> paths(1);
  paths[0].points = {surface_point(surface.mesh, VertexId(0)), surface_point(surface.mesh, VertexId(24))};
  EXPECT_THROW(fast.distances(paths), Error);  // no common face
  paths[0].points = {{FaceId(99), Vec3(1.0, 0.0, 0.0)}};
  EXPECT_THROW(fast.distances(paths), Error);
  const std::vector<VertexId> sources{VertexId(25)};
  EXPECT_THROW(geodesic_distances(surface.mesh, surface.positions, sources, GeodesicMethod::fast), Error);
}

}  // namespace
}  // namespace wilt
