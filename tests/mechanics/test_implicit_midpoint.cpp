#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

using Eigen::VectorXd;
using test::Blade;

const Edges kOneEdge = (Edges(1, 2) << 0, 1).finished();

// Two masses on a spring along x, rest length 1.
System oscillator(double mass, double stiffness) {
  System system(VectorXd::Constant(2, mass), {0, 0});
  system.add_energy("spring",
                    std::make_unique<Springs>(kOneEdge, VectorXd::Ones(1), VectorXd::Constant(1, stiffness)));
  return system;
}

MotionState stretched(double amplitude) {
  MotionState state;
  state.positions =
      (Points3(2, 3) << -0.5 * (1.0 + amplitude), 0, 0, 0.5 * (1.0 + amplitude), 0, 0).finished();
  return state;
}

// Oracle: the exact recurrence. The stretch s obeys s'' = -(2k/m) s, linear on a line, for which the midpoint
// rule is (s, v) <- Cayley transform; over 200 steps the last place of the positions (1e-16, over dt in the
// velocities) adds up.
TEST(ImplicitMidpoint, ReplaysTheMidpointRecurrenceOfAnOscillator) {
  System system = oscillator(0.8, 3.0);
  ImplicitMidpoint stepper(system, {.tolerance = 1e-14});
  MotionState state = stretched(0.2);
  const double dt = 0.1, w2 = 2.0 * 3.0 / 0.8, q = 0.25 * dt * dt * w2;
  double s = 0.2, v = 0.0;
  for (int k = 0; k < 200; ++k) {
    ASSERT_TRUE(stepper.step(state, dt).converged);
    const double s1 = ((1.0 - q) * s + dt * v) / (1.0 + q);
    v = ((1.0 - q) * v - dt * w2 * s) / (1.0 + q);
    s = s1;
    ASSERT_NEAR(state.positions(1, 0) - state.positions(0, 0) - 1.0, s, 1e-12) << "step " << k;
    ASSERT_NEAR(state.velocities(1, 0) - state.velocities(0, 0), v, 1e-11) << "step " << k;
  }
}

// Oracle: the dispersion of the midpoint rule, tan(omega_d dt/2) = omega dt/2, against the law's period 2
// pi/omega: the frequency read off ten periods of zero crossings, interpolated linearly (error of order dt^2
// of a phase, 1e-4).
TEST(ImplicitMidpoint, HasThePeriodThatTheDispersionSays) {
  const double mass = 1.0, stiffness = 2.0, dt = 0.3, omega = 2.0;
  System system = oscillator(mass, stiffness);
  ImplicitMidpoint stepper(system);
  MotionState state = stretched(0.1);
  double before = 0.1, first = -1.0, last = -1.0;
  int crossings = 0;
  for (int k = 1; crossings < 21; ++k) {
    stepper.step(state, dt);
    const double now = state.positions(1, 0) - state.positions(0, 0) - 1.0;
    if (before * now < 0.0) {
      last = dt * (k - now / (now - before));
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  const double measured = std::numbers::pi * 20.0 / (last - first);
  const double midpoint = 2.0 / dt * std::atan(0.5 * omega * dt);
  EXPECT_NEAR(measured, midpoint, 1e-3 * midpoint);
  EXPECT_GT(std::abs(measured - omega), 0.02 * omega) << "the step is large enough to tell the two apart";
}

// Oracle: conservation; the midpoint rule keeps quadratic energies exactly, and momentum.
TEST(ImplicitMidpoint, KeepsTheEnergyOfALinearOscillator) {
  System system = oscillator(0.5, 4.0);
  ImplicitMidpoint stepper(system, {.tolerance = 1e-14});
  MotionState state = stretched(0.3);
  const double energy = 0.5 * 4.0 * 0.09;
  for (int k = 0; k < 500; ++k) {
    const StepReport report = stepper.step(state, 0.2);
    ASSERT_TRUE(report.converged);
    const auto energies = system.energies(state.positions);
    ASSERT_EQ(energies.size(), 1u);
    ASSERT_NEAR(system.kinetic_energy(state.velocities) + energies[0].second, energy, 1e-12);
  }
  EXPECT_LT(state.velocities.colwise().sum().norm(), 1e-12);
}

// Oracle: convergence order; a nonlinear damped sheet, error against a run eight times finer than the finest;
// three levels, slope 2 within 0.2.
TEST(ImplicitMidpoint, ConvergesWithTheSquareOfTheStep) {
  const auto run = [](int steps) {
    Blade blade = test::blade(5);
    ImplicitMidpoint stepper(*blade.system, {.tolerance = 1e-12});
    for (int k = 0; k < steps; ++k) EXPECT_TRUE(stepper.step(blade.state, 0.8 / steps).converged);
    return blade.state.positions;
  };
  const Points3 reference = run(512);
  const double coarse = (run(16) - reference).norm(), middle = (run(32) - reference).norm(),
               fine = (run(64) - reference).norm();
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.2);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.2);
}

// Oracle: the state of rest is a fixed point, exactly.
TEST(ImplicitMidpoint, NothingMovesWithoutAForce) {
  Blade blade = test::blade(8);
  blade.load->set_values(Points3::Zero(81, 3));
  System system(blade.system->masses(), std::vector<char>(81, 0));
  const Stencil stencil = hinge_stencil(blade.shape.faces);
  system.add_energy("elastic", std::make_unique<Springs>(blade.shape.edges, blade.springs->rest_lengths(),
                                                         VectorXd::Constant(blade.shape.edges.rows(), 4.0)));
  system.add_energy("bending", std::make_unique<Hinges>(stencil, blade.shape.positions,
                                                        VectorXd::Constant(stencil.rows(), 1.0)));
  ImplicitMidpoint stepper(system);
  MotionState state = blade.state;
  for (int k = 0; k < 10; ++k) {
    const StepReport report = stepper.step(state, 0.1);
    ASSERT_TRUE(report.converged);
    ASSERT_EQ(system.kinetic_energy(state.velocities), 0.0);
  }
  EXPECT_EQ(state.positions, blade.state.positions);
}

// Oracle: free fall under gravity, exact for the midpoint rule (quadratic in time).
TEST(ImplicitMidpoint, FallsAsGalileiSays) {
  Blade blade = test::blade(4);
  System system(blade.system->masses(), std::vector<char>(25, 0));
  system.add_energy("gravity", std::make_unique<Gravity>(system.masses(), Vec3(0, 0, -2)));
  system.add_energy("elastic", std::make_unique<Springs>(blade.shape.edges, blade.springs->rest_lengths(),
                                                         VectorXd::Constant(blade.shape.edges.rows(), 4.0)));
  ImplicitMidpoint stepper(system, {.tolerance = 1e-13});
  MotionState state = blade.state;
  for (int k = 0; k < 20; ++k) stepper.step(state, 0.1);
  const Points3 fallen = blade.state.positions.rowwise() + Eigen::RowVector3d(0, 0, -4.0);
  EXPECT_LT((state.positions - fallen).cwiseAbs().maxCoeff(), 1e-11);
}

// Oracle: the definition; pinned vertices have the same bits, free ones moved, every step converged as
// reported.
TEST(ImplicitMidpoint, PinnedVerticesStay) {
  Blade blade = test::blade(12);
  ImplicitMidpoint stepper(*blade.system);
  int pinned = 0;
  for (int k = 0; k < 20; ++k) {
    const StepReport report = stepper.step(blade.state, 0.1);
    ASSERT_TRUE(report.converged) << report.reason;
    ASSERT_LE(report.residual, 1e-8);
    ASSERT_EQ(report.substeps, 1);
  }
  for (int i = 0; i < 169; ++i) {
    if (!blade.system->pinned()[i]) continue;
    ++pinned;
    ASSERT_EQ(blade.state.positions.row(i), blade.shape.positions.row(i));
    ASSERT_EQ(blade.state.velocities.row(i).norm(), 0.0);
  }
  EXPECT_GT(pinned, 0);
  EXPECT_GT((blade.state.positions - blade.shape.positions).cwiseAbs().maxCoeff(), 0.01);
}

// Oracle: the residual of the midpoint equation, evaluated here from the state alone.
TEST(ImplicitMidpoint, SatisfiesItsEquation) {
  Blade blade = test::blade(8);
  ImplicitMidpoint stepper(*blade.system, {.tolerance = 1e-10});
  for (int k = 0; k < 10; ++k) {
    const MotionState before = blade.state;
    ASSERT_TRUE(stepper.step(blade.state, 0.1).converged);
    if (k == 0) continue;
    const Points3 x = 0.5 * (before.positions + blade.state.positions);
    const Points3 v = 0.5 * (before.velocities + blade.state.velocities);
    Points3 force;
    const double scale = blade.system->total_force(x, v, force);
    double worst = 0.0, moved = 0.0;
    for (int i = 0; i < 81; ++i) {
      if (blade.system->pinned()[i]) continue;
      const double m = blade.system->masses()[i];
      const auto gained = m * (blade.state.velocities.row(i) - before.velocities.row(i)) / 0.1;
      worst = std::max(worst, (gained - force.row(i)).norm());
      moved =
          std::max(moved, (blade.state.positions.row(i) - before.positions.row(i) - 0.1 * v.row(i)).norm());
    }
    EXPECT_LT(worst, 1e-8 * scale);
    EXPECT_LT(moved, 1e-14);
  }
}

// A force that is not finite while dt is above a limit: a step that only halving can take.
class Brittle : public Force {
 public:
  explicit Brittle(double fastest) : fastest_(fastest) {}
  void add_force(const Points3&, const Points3& v, Points3& force) const override {
    force.col(0).array() += v.cwiseAbs().maxCoeff() > fastest_ ? std::nan("") : 1.0;
  }
  void add_jacobian(const Points3&, const Points3&, BlockMatrix&, double, double, Curvature) const override {}

 private:
  double fastest_;
};

// Oracle: planted; the midpoint velocity after a step of 0.8 from rest is 0.4, and no attempt above 0.12
// gives a finite force: 0.4 -> 0.2 -> 0.1 is two halvings. The result is the exact one, x = t^2/2, v = t,
// over the first substep.
TEST(ImplicitMidpoint, HalvesAStepThatDoesNotConverge) {
  System system(VectorXd::Ones(1), {0});
  system.add_force("brittle", std::make_unique<Brittle>(0.75));
  MotionState state;
  state.positions = Points3::Zero(1, 3);
  ImplicitMidpoint stepper(system);
  EXPECT_EQ(stepper.step(state, 0.4).substeps, 1);  // midpoint velocity 0.2
  EXPECT_NEAR(state.velocities(0, 0), 0.4, 1e-12);
  const StepReport report = stepper.step(state, 0.32);  // 0.56 in the middle: no halving
  EXPECT_EQ(report.substeps, 1);
  MotionState late = state;
  const StepReport failed =
      stepper.step(late, 0.2);  // 0.82 in the middle, and 0.72 + anything is too fast soon
  EXPECT_FALSE(failed.converged);
  EXPECT_NE(failed.reason.find("not finite"), std::string::npos) << failed.reason;
  EXPECT_NEAR(failed.dt, 0.2 / 256, 1e-15);
  EXPECT_EQ(late.positions, state.positions);
  EXPECT_EQ(late.velocities, state.velocities);
}

// Oracle: planted; with two Newton iterations allowed the full step of a violent start fails and shorter ones
// do it. The result must be that of the shorter steps taken by hand where they are all alike.
TEST(ImplicitMidpoint, CoversTheWholeStepWhenItHalves) {
  Blade blade = test::blade(6), same = test::blade(6);
  Random random(23, "violent");
  blade.state.velocities = test::random_points(49, 6.0, random);
  same.state.velocities = blade.state.velocities;
  ImplicitMidpoint few(*blade.system, {.tolerance = 1e-10, .max_newton = 9});
  const StepReport report = few.step(blade.state, 0.4);
  ASSERT_TRUE(report.converged) << report.reason;
  ASSERT_GT(report.substeps, 1);
  EXPECT_LE(report.dt, 0.2);
  ImplicitMidpoint strict(*same.system, {.tolerance = 1e-10});
  for (int k = 0; k < 64; ++k) ASSERT_TRUE(strict.step(same.state, 0.4 / 64).converged);
  const double moved = (same.state.positions - same.shape.positions).norm();
  EXPECT_LT((blade.state.positions - same.state.positions).norm(),
            0.3 * moved);  // the halved steps are coarse

  MotionState before = same.state;
  before.velocities = 50.0 * blade.state.velocities;
  MotionState state = before;
  ImplicitMidpoint never(*same.system, {.tolerance = 1e-10, .max_newton = 1, .max_halvings = 2});
  const StepReport failed = never.step(state, 0.4);
  EXPECT_FALSE(failed.converged);
  EXPECT_DOUBLE_EQ(failed.dt, 0.1);
  EXPECT_FALSE(failed.reason.empty());
  EXPECT_EQ(state.positions, before.positions);
  EXPECT_EQ(state.velocities, before.velocities);
}

// Oracle: differential; bytes on one and on two threads, on a sheet large enough to be divided.
TEST(ImplicitMidpoint, GivesTheSameBytesOnOneAndTwoThreads) {
  Points3 result[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Blade blade = test::blade(72);
    ImplicitMidpoint stepper(*blade.system);
    for (int k = 0; k < 2; ++k) ASSERT_TRUE(stepper.step(blade.state, 0.1).converged);
    result[threads - 1] = blade.state.positions;
  }
  EXPECT_EQ(std::memcmp(result[0].data(), result[1].data(), sizeof(double) * result[0].size()), 0);
}

// Oracle: differential, bytes; every leaf stepped by itself.
TEST(StepTogether, IsEveryStepByItself) {
  std::vector<Blade> together, alone;
  std::vector<ImplicitMidpoint> steppers;
  std::vector<MotionState> states;
  for (int k = 0; k < 5; ++k) {
    together.push_back(test::blade(6, 0.1 * k));
    alone.push_back(test::blade(6, 0.1 * k));
    steppers.emplace_back(*together.back().system);
    states.push_back(together.back().state);
  }
  for (int step = 0; step < 3; ++step) {
    const std::vector<StepReport> reports = step_together(steppers, states, 0.1);
    for (int k = 0; k < 5; ++k) {
      ImplicitMidpoint(*alone[k].system).step(alone[k].state, 0.1);
      EXPECT_TRUE(reports[k].converged);
      EXPECT_EQ(
          std::memcmp(states[k].positions.data(), alone[k].state.positions.data(), sizeof(double) * 147), 0);
    }
  }
  EXPECT_GT((states[0].positions - states[4].positions).norm(), 0.0);
  EXPECT_THROW(step_together(steppers, std::span(states).first(3), 0.1), Error);
}

// Oracle: differential; a run from the kept state is the uninterrupted run.
TEST(ImplicitMidpoint, RestartsFromItsState) {
  Blade a = test::blade(6), b = test::blade(6);
  ImplicitMidpoint one(*a.system);
  for (int k = 0; k < 10; ++k) one.step(a.state, 0.1);
  for (int k = 0; k < 10; ++k) ImplicitMidpoint(*b.system).step(b.state, 0.1);
  EXPECT_EQ(std::memcmp(a.state.positions.data(), b.state.positions.data(), sizeof(double) * 3 * 49), 0);
}

// Oracle: negative.
TEST(ImplicitMidpoint, RefusesBadInputAndReportsBadStates) {
  System system = oscillator(1.0, 1.0);
  EXPECT_THROW(ImplicitMidpoint(system, {.tolerance = 0.0}), Error);
  EXPECT_THROW(ImplicitMidpoint(system, {.max_newton = 0}), Error);
  EXPECT_THROW(System(VectorXd::Zero(1), {0}), Error);
  EXPECT_THROW(System(VectorXd::Ones(1), {0, 0}), Error);
  ImplicitMidpoint stepper(system);
  MotionState state = stretched(0.1);
  EXPECT_THROW(stepper.step(state, 0.0), Error);
  state.velocities = Points3::Zero(2, 3);
  state.velocities(1, 2) = NAN;
  const StepReport report = stepper.step(state, 0.1);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("vertex 1 is not finite"), std::string::npos) << report.reason;
  EXPECT_THROW(system.force_of("sprang", state.positions, state.velocities), Error);
}

}  // namespace
}  // namespace wilt
