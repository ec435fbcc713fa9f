// Symbols: x0, v0 the state at the start, d = x1 - x0, R the residual, M the masses, A = dt^2/2 dR/dd the
// matrix.
#include "wilt/mechanics/implicit_midpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr double kForcing = 0.02;       // a linear solve reduces its residual by this factor
constexpr double kSlowReduction = 0.1;  // an iteration that reduces less than this calls for a new matrix
constexpr int kMaxShortenings = 12;     // halvings of a Newton step
constexpr double kRoundOff = 8.0 * std::numeric_limits<double>::epsilon();

// R(d) and where it was taken.
struct Residual {
  Points3 position, velocity;  // midpoint
  Points3 values;              // R, 0 on pinned vertices
  double norm = 0.0;
  double force_scale = 0.0;

  void evaluate(const System& system, const MotionState& start, const Points3& d, double dt) {
    position = start.positions + 0.5 * d;
    velocity = d / dt;
    force_scale = system.total_force(position, velocity, values);
    const Eigen::VectorXd& m = system.masses();
    for (int i = 0; i < d.rows(); ++i) {
      if (system.pinned()[i])
        values.row(i).setZero();
      else
        values.row(i) = 2.0 * m[i] / dt * (d.row(i) / dt - start.velocities.row(i)) - values.row(i);
    }
    norm = std::sqrt(dot(values, values));
  }
};

double momentum_scale(const System& system, const MotionState& state, double dt) {
  double sum = 0.0;
  for (int i = 0; i < state.velocities.rows(); ++i)
    sum += std::pow(2.0 * system.masses()[i] / dt, 2) * state.velocities.row(i).squaredNorm();
  return std::sqrt(sum);
}

// What one unit in the last place of every position does to R.
double round_off(const System& system, const BlockMatrix* matrix, const Points3& x, double dt) {
  double sum = 0.0;
  for (int i = 0; i < x.rows(); ++i) {
    if (system.pinned()[i]) continue;
    const double diagonal =
        matrix ? matrix->block(matrix->pattern().diagonal(i)).trace() / 3.0 : system.masses()[i];
    sum += diagonal * diagonal * x.row(i).squaredNorm();
  }
  return kRoundOff * 2.0 / (dt * dt) * std::sqrt(sum);
}

Points3 first_guess(const System& system, const MotionState& state, double dt) {
  Points3 d = dt * state.velocities + 0.5 * dt * dt * state.accelerations;
  for (int i = 0; i < d.rows(); ++i) {
    if (system.pinned()[i]) d.row(i).setZero();
  }
  return d;
}

int first_not_finite(const Points3& values) {
  for (int i = 0; i < values.rows(); ++i) {
    if (!values.row(i).allFinite()) return i;
  }
  return -1;
}

}  // namespace

void MidpointOptions::validate() const {
  if (!(tolerance > 0.0) || !(tolerance < 1.0))
    throw Error(ErrorCode::configuration,
                fmt::format("the integrator's tolerance is {}; it must lie between 0 and 1", tolerance));
  if (max_newton < 1 || max_linear < 1)
    throw Error(
        ErrorCode::configuration,
        fmt::format("max_newton is {} and max_linear {}; both must be at least 1", max_newton, max_linear));
  if (max_halvings < 0 || max_halvings > 30)
    throw Error(ErrorCode::configuration,
                fmt::format("max_halvings is {}; it must lie between 0 and 30", max_halvings));
}

ImplicitMidpoint::ImplicitMidpoint(System& system, const MidpointOptions& options)
    : system_(&system), options_(options), matrix_(system.make_pattern()) {
  options.validate();
}

StepReport ImplicitMidpoint::step(MotionState& state, double dt) {
  const int n = system_->vertex_count();
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw Error(ErrorCode::configuration, fmt::format("the time step is {}; it must be above 0", dt));
  if (state.positions.rows() != n)
    throw Error(ErrorCode::configuration,
                fmt::format("{} positions for {} masses; give one per vertex", state.positions.rows(), n));
  MotionState next = state;
  if (next.velocities.rows() != n) next.velocities.setZero(n, 3);
  if (next.accelerations.rows() != n) next.accelerations.setZero(n, 3);

  StepReport report;
  report.dt = dt;
  const int bad = std::max({first_not_finite(next.positions), first_not_finite(next.velocities),
                            first_not_finite(next.accelerations)});
  if (bad >= 0) {
    report.converged = false;
    report.reason = fmt::format("the motion of vertex {} is not finite before the step", bad);
    return report;
  }
  report.converged = advance(next, dt, options_.max_halvings, report);
  if (report.converged) {
    report.reason.clear();
    state = std::move(next);
    report.kinetic = system_->kinetic_energy(state.velocities);
    report.energies = system_->energies(state.positions);
  }
  return report;
}

bool ImplicitMidpoint::advance(MotionState& state, double dt, int halvings_left, StepReport& report) {
  report.dt = std::min(report.dt, dt);
  if (solve(state, dt, report)) {
    ++report.substeps;
    return true;
  }
  if (halvings_left == 0) return false;
  return advance(state, 0.5 * dt, halvings_left - 1, report) &&
         advance(state, 0.5 * dt, halvings_left - 1, report);
}

bool ImplicitMidpoint::solve(MotionState& state, double dt, StepReport& report) {
  const auto fail = [&](std::string reason) {
    report.reason = fmt::format("{} at a step of {}", reason, dt);
    return false;
  };
  Points3 d = first_guess(*system_, state, dt), delta, trial_d;
  Residual current, trial;
  current.evaluate(*system_, state, d, dt);
  if (!std::isfinite(current.norm)) return fail("a force is not finite where the iteration starts");
  const double scale = std::max(current.force_scale, momentum_scale(*system_, state, dt));
  double target = std::max(options_.tolerance * scale, round_off(*system_, nullptr, state.positions, dt));

  Curvature curvature = Curvature::exact;
  bool matrix_wanted = true;
  for (int iteration = 0; current.norm > target; ++iteration) {
    if (iteration == options_.max_newton)
      return fail(fmt::format("no convergence in {} iterations (residual {:.3g} of {:.3g})", iteration,
                              current.norm, scale));
    ++report.newton;
    const bool fresh = matrix_wanted;
    if (matrix_wanted) {
      system_->assemble(current.position, current.velocity, 0.25 * dt * dt, 0.5 * dt, curvature, matrix_);
      target = std::max(options_.tolerance * scale, round_off(*system_, &matrix_, state.positions, dt));
      if (current.norm <= target) break;
      matrix_wanted = false;
    }
    const double factor = 0.5 * dt * dt;  // R is a force, A is masses
    const double forcing = std::max(kForcing, 0.5 * target / current.norm);
    const CgResult linear = solve_cg(matrix_, -factor * current.values, system_->pinned(),
                                     forcing * factor * current.norm, options_.max_linear, delta);
    report.linear += linear.iterations;
    if (linear.status == CgStatus::negative_curvature) {
      if (curvature == Curvature::semidefinite) return fail("the matrix is not positive definite");
      curvature = Curvature::semidefinite;
      matrix_wanted = true;
      continue;
    }

    double length = 1.0;
    bool shorter = false;
    for (int k = 0; k <= kMaxShortenings && !shorter; ++k) {
      trial_d = d + length * delta;
      trial.evaluate(*system_, state, trial_d, dt);
      shorter = std::isfinite(trial.norm) && trial.norm < (1.0 - 1e-4 * length) * current.norm;
      if (!shorter && !fresh) break;  // try a new matrix before a shorter step
      if (!shorter) length *= 0.5;
    }
    if (!shorter) {
      if (fresh && curvature == Curvature::semidefinite)
        return fail("no step along Newton's direction helps");
      if (fresh) curvature = Curvature::semidefinite;
      matrix_wanted = true;
      continue;
    }
    matrix_wanted = trial.norm > kSlowReduction * current.norm;
    std::swap(d, trial_d);
    std::swap(current, trial);
  }

  report.residual = std::max(report.residual, scale > 0.0 ? current.norm / scale : 0.0);
  const Points3 v1 = 2.0 / dt * d - state.velocities;
  for (int i = 0; i < d.rows(); ++i) {
    if (system_->pinned()[i]) {
      state.velocities.row(i).setZero();
      state.accelerations.row(i).setZero();
      continue;
    }
    state.positions.row(i) += d.row(i);
    state.accelerations.row(i) = (v1.row(i) - state.velocities.row(i)) / dt;
    state.velocities.row(i) = v1.row(i);
  }
  return true;
}

}  // namespace wilt
