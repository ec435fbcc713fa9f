#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "support/meshes.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/self_intersection.hpp"

namespace wilt {
namespace {

constexpr double kPi = std::numbers::pi;

// A strip of length 1 and width 0.6, the petiole in the middle of its lower end.
struct Strip {
  test::Surface surface = test::grid(30, 50, 0.6, 1.0);
  VertexId petiole{15}, tip{50 * 31 + 15};
  LeafMetrics metrics{surface.mesh, surface.positions, petiole, {tip}};
};

// Rolled about x with constant curvature, by `angle` in all.
Points3 rolled(const Strip& strip, double angle) {
  return test::bent(strip.surface,
                    [&](const Vec3& p) {
                      const double r = 1.0 / angle;
                      return Vec3(p.x(), r * std::sin(p.y() / r), r * (1.0 - std::cos(p.y() / r)));
                    })
      .positions;
}

// Oracle: a circular roll turns the normals within 0.12 of the far end by the angle of their mean place; the
// mean normal of the symmetric base ring is that of the base.
TEST(Curl, IsTheAngleOfARoll) {
  const Strip strip;
  for (const double degrees : {20.0, 60.0, 120.0}) {
    const double angle = degrees * kPi / 180.0;
    // The tip's neighbourhood is a half disc of radius 0.12 whose centroid lies 4 r / (3 pi) = 0.051 inside;
    // the grid of 0.02 makes that uncertain by 0.01 of the length.
    EXPECT_NEAR(strip.metrics.curl(rolled(strip, angle)), angle * (1.0 - 0.051), 0.02 * angle) << degrees;
  }
  EXPECT_NEAR(strip.metrics.curl(strip.surface.positions), 0.0, 1e-7);  // acos-free, so round-off only
}

// Oracle: model figure, a smooth roll of 60 degrees scores below 1e-4.
TEST(Wrinkle, DoesNotCountASmoothRoll) {
  const Strip strip;
  EXPECT_LT(strip.metrics.wrinkle(rolled(strip, kPi / 3)), 1e-4);
  EXPECT_LT(strip.metrics.wrinkle(strip.surface.positions), 1e-12);
}

// Oracle: a ripple of amplitude a much shorter than the fitting disc has RMS a / sqrt(2), less the little
// that a quadric can follow; twice the amplitude is twice the score.
TEST(Wrinkle, MeasuresTheAmplitudeOfARipple) {
  const Strip strip;
  const auto ripple = [&](double amplitude) {
    return test::bent(
               strip.surface,
               [&](const Vec3& p) { return Vec3(p.x(), p.y(), amplitude * std::sin(2 * kPi * p.y() / 0.1)); })
        .positions;
  };
  const double one = strip.metrics.wrinkle(ripple(0.001)), two = strip.metrics.wrinkle(ripple(0.002));
  EXPECT_NEAR(one, 0.001 / std::sqrt(2.0), 0.15 * 0.001);
  EXPECT_NEAR(two / one, 2.0, 0.05);
}

// Oracle: rigid motion changes nothing.
TEST(Metrics, AreInvariantToRigidMotion) {
  const Strip strip;
  const Points3 shape = rolled(strip, 1.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Points3 moved = (shape * turn.transpose()).rowwise() + Vec3(3, -2, 1).transpose();
  const FrameMetrics a = strip.metrics.measure(shape, 0), b = strip.metrics.measure(moved, 0);
  EXPECT_NEAR(a.wrinkle, b.wrinkle, 1e-10);
  EXPECT_NEAR(a.curl, b.curl, 1e-10);
  EXPECT_NEAR(a.area_ratio, b.area_ratio, 1e-12);
  EXPECT_NEAR(a.max_strain, b.max_strain, 1e-12);
}

// Oracle: a uniform stretch by 10 % along y.
TEST(Metrics, MeasureAreaAndStrainOfAStretch) {
  const Strip strip;
  const Points3 stretched =
      test::bent(strip.surface, [](const Vec3& p) { return Vec3(p.x(), 1.1 * p.y(), p.z()); }).positions;
  const FrameMetrics m = strip.metrics.measure(stretched, 3);
  EXPECT_EQ(m.iteration, 3);
  EXPECT_NEAR(m.area_ratio, 1.1, 1e-12);
  EXPECT_NEAR(m.projected_area_ratio, 1.1, 1e-12);
  EXPECT_NEAR(m.max_strain, 0.1, 1e-12);
  EXPECT_EQ(m.self_intersections, 0);
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int brute_force(const Faces& faces, const Points3& positions) {
  const auto point = [&](int v) {
    return Kernel::Point_3(positions(v, 0), positions(v, 1), positions(v, 2));
  };
  int count = 0;
  for (int f = 0; f < faces.rows(); ++f) {
    for (int g = f + 1; g < faces.rows(); ++g) {
      bool shared = false;
      for (int i = 0; i < 9; ++i) shared = shared || faces(f, i / 3) == faces(g, i % 3);
      if (shared) continue;
      const Kernel::Triangle_3 a(point(faces(f, 0)), point(faces(f, 1)), point(faces(f, 2)));
      const Kernel::Triangle_3 b(point(faces(g, 0)), point(faces(g, 1)), point(faces(g, 2)));
      count += CGAL::do_intersect(a, b) ? 1 : 0;
    }
  }
  return count;
}

// Oracle: CGAL's exact predicate on every pair, on a sheet rolled up through itself and on random crumples.
TEST(SelfIntersections, EqualAnExactCountOfAllPairs) {
  const Strip strip;
  EXPECT_EQ(count_self_intersections(strip.surface.mesh.face_matrix(), strip.surface.positions), 0);
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed, "crumple");
    const test::Surface small = test::grid(12, 12);
    Points3 crumpled = small.positions;
    for (int v = 0; v < crumpled.rows(); ++v) {
      for (int k = 0; k < 3; ++k) crumpled(v, k) += random.uniform(-0.15, 0.15);
    }
    const int expected = brute_force(small.mesh.face_matrix(), crumpled);
    EXPECT_GT(expected, 100) << "seed " << seed;
    EXPECT_EQ(count_self_intersections(small.mesh.face_matrix(), crumpled), expected) << "seed " << seed;
  }
}

}  // namespace
}  // namespace wilt
