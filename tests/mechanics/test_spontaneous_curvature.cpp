// A sheet that wants to be curved becomes a cylinder of that curvature, whatever its triangles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mechanics/spontaneous_curvature.hpp"

namespace wilt {
namespace {

using Tensors = std::vector<Eigen::Matrix3d>;

Tensors roll(int count, const Vec3& across, double curvature) {
  return Tensors(count, curvature * across * across.transpose());
}

// The flat sheet rolled up onto a cylinder of curvature k about an axis in its plane, without stretching.
Points3 rolled(const Points3& flat, const Vec3& across, double k) {
  const Vec3 axis = Vec3::UnitZ().cross(across);
  Points3 x = flat;
  for (int i = 0; i < x.rows(); ++i) {
    const Vec3 p = flat.row(i).transpose();
    const double s = k * p.dot(across);
    x.row(i) =
        (p.dot(axis) * axis + std::sin(s) / k * across + (1.0 - std::cos(s)) / k * Vec3::UnitZ()).transpose();
  }
  return x;
}

// Oracle: the dihedral angles of the sheet rolled onto the cylinder; the difference of an angle of order k h
// is of order (k h)^3. Irregular triangles, an axis askew to them, both signs.
TEST(SpontaneousCurvature, GivesTheAnglesOfACylinderOnAnyTriangulation) {
  const Vec3 across(std::cos(0.4), std::sin(0.4), 0.0);
  for (const double k : {0.9, -0.9}) {
    std::vector<double> errors;
    for (const int cells : {8, 16, 32}) {
      const test::Sheet sheet = test::sheet(cells, 2.0, 0.0, 3);
      const Stencil hinges = hinge_stencil(sheet.faces);
      const Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(hinges.rows());
      const Eigen::VectorXd expected =
          Hinges(hinges, sheet.positions, stiffness).angles(rolled(sheet.positions, across, k));
      const Eigen::VectorXd angles = curvature_angles(
          hinges, sheet.positions, roll(static_cast<int>(sheet.positions.rows()), across, k));
      errors.push_back(std::sqrt((angles - expected).squaredNorm() / static_cast<double>(angles.size())));
      EXPECT_GT(expected.cwiseAbs().maxCoeff(), 1.5 / cells);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3.0, 0.2);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 3.0, 0.2);
    EXPECT_LT(errors[2], 1e-3 * 2.0 / 32);
  }
}

// Curvature, along its length, of a strip 4 x 1 held at one end that was let go until it came to rest.
double relaxed_curvature(int cells, double k) {
  test::Sheet strip = test::sheet(cells, 4.0, 0.0, 5);
  strip.positions.col(1) *= 0.25;
  const int n = static_cast<int>(strip.positions.rows()), e = static_cast<int>(strip.edges.rows());
  const double h = 4.0 / cells;
  std::vector<char> pinned(n, 0);
  for (int i = 0; i < n; ++i) pinned[i] = strip.positions(i, 0) < 1e-9;
  System system(Eigen::VectorXd::Constant(n, 1.0 / n), pinned);
  system.add_energy("elastic",
                    std::make_unique<Springs>(strip.edges, test::lengths(strip.edges, strip.positions),
                                              Eigen::VectorXd::Constant(e, 100.0)));
  const Stencil hinges = hinge_stencil(strip.faces);
  Hinges& bending = system.add_energy(
      "bending",
      std::make_unique<Hinges>(hinges, strip.positions, Eigen::VectorXd::Constant(hinges.rows(), 0.1)));
  ImplicitMidpoint integrator(system);
  MotionState state;
  state.positions = strip.positions;
  const Eigen::VectorXd angles = curvature_angles(hinges, strip.positions, roll(n, Vec3::UnitX(), k));
  for (int step = 1; step <= 60; ++step) {  // the angles grow, then the motion is taken out at every step
    bending.set_rest_angles(std::min(1.0, step / 30.0) * angles);
    EXPECT_TRUE(integrator.step(state, 0.5).converged);
    state.velocities.setZero(n, 3);
    state.accelerations.setZero(n, 3);
  }
  // Turning of the chords along the lower side between its first and its last edge.
  const auto chord = [&](int i) {
    return Vec3((state.positions.row(i + 1) - state.positions.row(i)).transpose());
  };
  const double turning =
      std::acos(std::clamp(chord(1).normalized().dot(chord(cells - 2).normalized()), -1.0, 1.0));
  return turning / (h * (cells - 3));
}

// Oracle: analytic, the arc of radius 1/k that has no energy; second order in the edge length (measured: 0.06
// to 0.13 (k h)^2 of k).
TEST(SpontaneousCurvature, BendsAFlatStripIntoAnArcOfItsRadius) {
  const double k = 0.5;
  for (const int cells : {6, 12, 20}) {
    const double h = 4.0 / cells;
    EXPECT_NEAR(relaxed_curvature(cells, k), k, 0.2 * std::pow(k * h, 2) * k) << cells;
  }
}

// Oracle: by hand: a tensor along x is felt across edges along y, not across edges along x.
TEST(SpontaneousCurvature, ActsAcrossTheEdge) {
  Points3 x(4, 3);
  x << 0, 0, 0, 0, 1, 0, -1, 0.5, 0, 1, 0.5, 0;  // an edge along y, a triangle on either side
  const Stencil hinge = (Stencil(1, 4) << 0, 1, 2, 3).finished();
  EXPECT_NEAR(across_hinges(hinge, x, roll(4, Vec3::UnitX(), 3.0))[0], 3.0, 1e-15);
  EXPECT_NEAR(across_hinges(hinge, x, roll(4, Vec3::UnitY(), 3.0))[0], 0.0, 1e-15);
  EXPECT_NEAR(curvature_angles(hinge, x, roll(4, Vec3::UnitX(), 0.3))[0], -0.3, 1e-15);
  EXPECT_NEAR(curvature_angles(hinge, x, roll(4, Vec3::UnitX(), 30.0))[0], -0.5 * std::numbers::pi, 1e-15);
  x(3, 0) = 0.0;  // the right triangle has no area
  EXPECT_EQ(curvature_angles(hinge, x, roll(4, Vec3::UnitX(), 0.3))[0], 0.0);
}

// Oracle: negative.
TEST(SpontaneousCurvature, RefusesAWrongCount) {
  const test::Sheet sheet = test::sheet(2, 1.0, 0.0, 1);
  EXPECT_THROW(curvature_angles(hinge_stencil(sheet.faces), sheet.positions, roll(4, Vec3::UnitX(), 1.0)),
               Error);
}

}  // namespace
}  // namespace wilt
