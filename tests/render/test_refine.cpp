// The finer mesh of a picture, and the rest on a table.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "render/scenes.hpp"
#include "wilt/core/random.hpp"
#include "wilt/render/refine.hpp"
#include "wilt/render/resting_pose.hpp"

namespace wilt {
namespace {

// A disc of one fan over `corners` points of the unit circle, its normals up.
Surface disc(int corners) {
  Points3 positions(corners + 1, 3);
  Faces faces(corners, 3);
  positions.row(corners).setZero();
  for (int i = 0; i < corners; ++i) {
    const double a = 2.0 * std::numbers::pi * i / corners;
    positions.row(i) << std::cos(a), std::sin(a), 0.0;
    faces.row(i) << i, (i + 1) % corners, corners;
  }
  Surface surface = test::drawn(positions, faces, Vec3::Constant(0.5), true);
  surface.normals = Vec3::UnitZ().transpose().replicate(corners + 1, 1);
  return surface;
}

// Invariance: vertices stay and come first, a flat mesh stays flat, faces quadruple and keep their area.
TEST(Refine, KeepsVerticesAndFlatness) {
  Surface surface = test::square(1.0, 0.3, Vec3(0.1, 0.2, 0.3), true);
  surface.normals = Vec3::UnitZ().transpose().replicate(4, 1);
  const Points3 before = surface.positions;
  refine(surface, 3);
  EXPECT_EQ(surface.faces.rows(), 2 * 64);
  EXPECT_EQ(surface.positions.rows(), 81);
  EXPECT_EQ((surface.positions.topRows(4) - before).norm(), 0.0);
  EXPECT_NEAR((surface.positions.col(2).array() - 0.3).abs().maxCoeff(), 0.0, 1e-15);
  EXPECT_NEAR((surface.colours.rowwise() - Eigen::RowVector3d(0.1, 0.2, 0.3)).norm(), 0.0, 1e-14);
  double area = 0.0;
  for (int f = 0; f < surface.faces.rows(); ++f) {
    const auto p = [&](int i) -> Vec3 { return surface.positions.row(surface.faces(f, i)).transpose(); };
    area += 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).z();
  }
  EXPECT_NEAR(area, 4.0, 1e-12);
}

// Convergence: on a sphere with its exact normals the new points are off by O(h^4): a factor of 16 +- 25 %.
TEST(Refine, FollowsASphere) {
  double last = 0.0;
  for (const int rings : {8, 16, 32}) {
    Surface sphere = test::sphere(rings, Vec3::Ones());
    sphere.normals = sphere.positions;
    refine(sphere, 1);
    const double error = (sphere.positions.rowwise().norm().array() - 1.0).abs().maxCoeff();
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 16.0, 4.0);
    }
    last = error;
  }
}

// Convergence: so does the margin of a disc; the corners of a square stay corners and its sides straight.
TEST(Refine, RoundsASmoothMarginAndKeepsCorners) {
  double last = 0.0;
  for (const int corners : {12, 24, 48}) {
    Surface surface = disc(corners);
    refine(surface, 1);
    double error = 0.0;
    const auto loops = margin_loops(surface.positions, surface.faces);
    for (const int v : loops.at(0)) error = std::max(error, std::abs(surface.positions.row(v).norm() - 1.0));
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 16.0, 4.0);
    }
    last = error;
  }
  Surface square = disc(4);
  refine(square, 2);
  EXPECT_NEAR(square.positions.leftCols(2).rowwise().lpNorm<1>().maxCoeff(), 1.0, 1e-15);
}

// Property: a seam, where vertices stand twice, is neither opened nor taken for the margin.
TEST(Refine, LeavesSeamsClosed) {
  Surface surface = disc(24);
  const int twin = static_cast<int>(surface.positions.rows());
  surface.positions.conservativeResize(twin + 1, 3);
  surface.positions.row(twin) = surface.positions.row(24);
  surface.normals = Vec3::UnitZ().transpose().replicate(twin + 1, 1);
  surface.colours = Points3::Constant(twin + 1, 3, 0.5);
  for (int f = 0; f < 12; ++f) surface.faces(f, 2) = twin;
  ASSERT_EQ(margin_loops(surface.positions, surface.faces).size(), 1u);
  refine(surface, 2);
  const auto loops = margin_loops(surface.positions, surface.faces);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 96u);
}

// Analytic: three legs of different lengths under a disc: the plane through their feet becomes level.
TEST(Resting, AStoolStandsOnItsThreeLegs) {
  Points3 points(4, 3);
  points << 1.0, 0.0, -0.5, -0.6, 0.8, -0.3, -0.6, -0.8, -0.1, 0.0, 0.0, 0.2;
  const Eigen::Matrix3d turn = resting_rotation(points, Vec3(0.0, 0.0, 0.0));
  const Points3 stood = points * turn.transpose();
  EXPECT_NEAR(stood(0, 2), stood(1, 2), 1e-12);
  EXPECT_NEAR(stood(0, 2), stood(2, 2), 1e-12);
  EXPECT_GT(stood(3, 2), stood(0, 2));
  EXPECT_NEAR((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
}

// Property: any body comes to stand on three points or more, none below, its centre above their triangle.
TEST(Resting, AnyBodyComesToRest) {
  Random random(3, "bodies");
  for (int trial = 0; trial < 200; ++trial) {
    Points3 points(40, 3);
    for (int i = 0; i < points.rows(); ++i)
      points.row(i) << random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-0.3, 0.3);
    const Vec3 centre = points.colwise().mean().transpose();
    const Eigen::Matrix3d turn = resting_rotation(points, centre);
    const Points3 stood = points * turn.transpose();
    const double ground = stood.col(2).minCoeff();
    std::vector<Vec2> feet;
    for (int i = 0; i < stood.rows(); ++i)
      if (stood(i, 2) < ground + 1e-9) feet.push_back(stood.row(i).head<2>().transpose());
    ASSERT_EQ(feet.size(), 3u) << trial;
    const Vec2 c = (turn * centre).head<2>();
    const auto side = [&](int k) {
      const Vec2 a = feet[std::size_t(k)], b = feet[std::size_t((k + 1) % 3)];
      return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
    };
    EXPECT_TRUE((side(0) >= -1e-9 && side(1) >= -1e-9 && side(2) >= -1e-9) ||
                (side(0) <= 1e-9 && side(1) <= 1e-9 && side(2) <= 1e-9))
        << trial;
  }
}

}  // namespace
}  // namespace wilt
