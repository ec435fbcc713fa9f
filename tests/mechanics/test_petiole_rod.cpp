#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/petiole_rod.hpp"

namespace wilt {
namespace {

using Eigen::VectorXd;

// A straight rod of length 1 along x: the blade at x = 1 (row 0), the clamp at the origin.
Points3 straight(int segments) {
  Points3 line = Points3::Zero(segments + 1, 3);
  for (int i = 0; i <= segments; ++i) line(i, 0) = 1.0 - static_cast<double>(i) / segments;
  return line;
}

RodEquilibrium bend(int segments, const RodLoads& loads, double stiffness = 1.0, double mass = 0.0) {
  PetioleRod rod(straight(segments), VectorXd::Constant(segments, mass / segments));
  RodEquilibrium result = rod.solve(loads, VectorXd::Constant(segments, stiffness));
  EXPECT_TRUE(result.converged) << "residual " << result.residual;
  return result;
}

double turn(const RodEquilibrium& rod) {
  return Eigen::AngleAxisd(rod.rotation).angle();
}

// Oracle: Euler-Bernoulli, deflection P L^3/(3 EI), slope P L^2/(2 EI); quadratic convergence in the
// segments. The load is so small that the geometry's own error, of second order in the slope, is 1e-8 of the
// deflection.
TEST(PetioleRod, DeflectsAsACantileverUnderATipForce) {
  const double force = 1e-4;
  double last_error = 0.0;
  for (const int segments : {5, 10, 20}) {
    const RodEquilibrium rod = bend(segments, {.force = Vec3(0, 0, -force)});
    const double error = std::abs(-rod.centreline(0, 2) / (force / 3.0) - 1.0);
    EXPECT_LT(error, 0.6 / (segments * segments));
    EXPECT_NEAR(turn(rod) / (force / 2.0), 1.0, 0.6 / (segments * segments));
    if (last_error > 0.0) {
      EXPECT_NEAR(std::log2(last_error / error), 2.0, 0.2);
    }
    last_error = error;
  }
}

// Oracle: Euler-Bernoulli under its own weight q: q L^4/(8 EI), slope q L^3/(6 EI); and in another stiffness.
TEST(PetioleRod, DeflectsAsACantileverUnderItsOwnWeight) {
  const RodEquilibrium rod = bend(40, {.gravity = Vec3(0, 0, -10)}, 2.0, 1e-5);
  EXPECT_NEAR(-rod.centreline(0, 2) / (1e-4 / 16.0), 1.0, 1e-3);
  EXPECT_NEAR(turn(rod) / (1e-4 / 12.0), 1.0, 1e-3);
}

// Oracle: analytic; a moment bends the rod to a circle of radius EI/M, whatever its size: the end's turn is M
// L/EI.
TEST(PetioleRod, AMomentBendsItToACircle) {
  const double moment = 2.0;
  const RodEquilibrium rod = bend(80, {.moment = Vec3(0, moment, 0)});
  EXPECT_NEAR(turn(rod), moment, 1e-9);
  EXPECT_NEAR(rod.centreline(0, 0), std::sin(moment) / moment,
              1e-4);  // chords: (L/80)^2 / 24 of the curvature
  EXPECT_NEAR(rod.centreline(0, 2), -(1.0 - std::cos(moment)) / moment, 1e-4);
}

// Oracle: the elastica (Bisshopp and Drucker 1945; Mattiasson 1981): P L^2/EI = 1: 0.30172 down, 0.05643 in;
// P L^2/EI = 5: 0.71379 down, 0.38763 in. The chords of 80 segments leave some 1e-4.
TEST(PetioleRod, FollowsTheElasticaFarFromStraight) {
  const RodEquilibrium one = bend(80, {.force = Vec3(0, 0, -1)});
  EXPECT_NEAR(-one.centreline(0, 2), 0.30172, 2e-4);
  EXPECT_NEAR(1.0 - one.centreline(0, 0), 0.05643, 2e-4);
  const RodEquilibrium five = bend(80, {.force = Vec3(0, 0, -5)});
  EXPECT_NEAR(-five.centreline(0, 2), 0.71379, 3e-4);
  EXPECT_NEAR(1.0 - five.centreline(0, 0), 0.38763, 3e-4);
}

// Oracle: statics; a small force on an arm is that force and its moment: slope P L^2/2 + P a L over EI.
TEST(PetioleRod, TheArmAddsItsMoment) {
  const RodEquilibrium rod = bend(40, {.force = Vec3(0, 0, -1e-4), .arm = Vec3(0.5, 0, 0)});
  EXPECT_NEAR(turn(rod) / 1e-4, 1.0, 1e-3);
}

// Oracle: invariance; lengths stay, and a turned rod under turned loads is the turned result.
TEST(PetioleRod, TurnsWithItsLoads) {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Points3 line = straight(12);
  for (int i = 0; i < line.rows(); ++i) line(i, 1) = 0.2 * std::sin(3.0 * line(i, 0));
  const Points3 line2 = line * turned.transpose();
  const VectorXd masses = VectorXd::Constant(12, 0.05), stiffness = VectorXd::LinSpaced(12, 0.5, 2.0);
  const RodLoads loads{.gravity = {0, 0, -9}, .force = {0.3, -0.4, -1}, .arm = {0.2, 0.3, 0}};
  const RodLoads loads2{
      .gravity = turned * loads.gravity, .force = turned * loads.force, .arm = turned * loads.arm};
  const RodEquilibrium a = PetioleRod(line, masses).solve(loads, stiffness);
  const RodEquilibrium b = PetioleRod(line2, masses).solve(loads2, stiffness);
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_LT((a.centreline * turned.transpose() - b.centreline).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((turned * a.rotation * turned.transpose() - b.rotation).cwiseAbs().maxCoeff(), 1e-8);
  for (int s = 0; s < 12; ++s)
    EXPECT_NEAR((a.centreline.row(s) - a.centreline.row(s + 1)).norm(),
                (line.row(s) - line.row(s + 1)).norm(), 1e-13);
}

// Oracle: the definition; balanced, the drawn shape is the equilibrium, and a softer stalk then droops below
// it.
TEST(PetioleRod, BalancedItHangsAsDrawnAndDroopsAsItSoftens) {
  const Points3 line = straight(16);
  PetioleRod rod(line, VectorXd::Constant(16, 0.01));
  const RodLoads loads{.gravity = {0, 0, -9.81}, .force = {0, 0, -0.8}, .arm = {0.4, 0.1, 0}};
  VectorXd stiffness = VectorXd::Constant(16, 1.0);
  rod.balance(loads, stiffness);
  const RodEquilibrium fresh = rod.solve(loads, stiffness);
  ASSERT_TRUE(fresh.converged);
  EXPECT_LT((fresh.centreline - line).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((fresh.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  double height = 0.0;
  for (const double turgor : {0.8, 0.5, 0.2, 0.05}) {
    const RodEquilibrium dry = rod.solve(loads, turgor * stiffness);
    ASSERT_TRUE(dry.converged) << "turgor " << turgor << " residual " << dry.residual;
    EXPECT_LT(dry.centreline(0, 2), height);
    height = dry.centreline(0, 2);
  }
}

// Oracle: a hair under a load a thousand times its stiffness hangs straight down: length 1 below the clamp.
// Also from the upright position, which is an (unstable) equilibrium but for a small sideways force.
TEST(PetioleRod, ConvergesForALimpStalk) {
  for (const double load : {10.0, 1e3, 1e4}) {
    const RodEquilibrium rod = bend(20, {.force = Vec3(0, 0, -load)});
    EXPECT_LT(rod.iterations, 200);
    EXPECT_LT(rod.centreline(0, 2), load > 1e3 ? -0.95 : -0.7);
  }
  const RodEquilibrium pushed = bend(20, {.force = Vec3(-100, 0, -1e-3)});
  EXPECT_LT(pushed.centreline(0, 0), 0.0)
      << "pushed along its axis far beyond Euler's load it must fold over";
}

// Oracle: no load, no bend; and the round section's formulas.
TEST(PetioleRod, StaysWithoutLoad) {
  const RodEquilibrium rod = bend(8, {});
  EXPECT_EQ(rod.centreline, straight(8));
  EXPECT_EQ(rod.iterations, 0);
  const VectorXd radii = VectorXd::Constant(9, 2.0);
  EXPECT_NEAR(round_bending_stiffness(radii, 3.0)[0], 3.0 * std::numbers::pi * 4.0, 1e-12);
  EXPECT_NEAR(round_segment_masses(straight(8), radii, 5.0)[3], 5.0 * std::numbers::pi * 4.0 / 8.0, 1e-12);
}

// Oracle: negative.
TEST(PetioleRod, RefusesBadInput) {
  EXPECT_THROW(PetioleRod(Points3::Zero(1, 3), VectorXd(0)), Error);
  EXPECT_THROW(PetioleRod(Points3::Zero(3, 3), VectorXd::Zero(2)), Error);
  PetioleRod rod(straight(2), VectorXd::Zero(2));
  EXPECT_THROW(rod.solve({}, VectorXd::Zero(2)), Error);
  EXPECT_THROW(rod.solve({}, VectorXd::Ones(3)), Error);
  EXPECT_THROW(rod.solve({.force = Vec3(0, 0, NAN)}, VectorXd::Ones(2)), Error);
}

}  // namespace
}  // namespace wilt
