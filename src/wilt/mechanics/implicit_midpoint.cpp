#include "wilt/mechanics/implicit_midpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/argument_checks.hpp"
#include "wilt/mechanics/chebyshev_midpoint.hpp"
#include "wilt/mechanics/newton_solve.hpp"

namespace wilt {
namespace {

// Substeps of a step, accepted or not: all that eight halvings can ask for, and as many again.
constexpr int kMostSubsteps = 1000;

int first_not_finite(const MotionState& state) {
  for (int i = 0; i < state.positions.rows(); ++i) {
    if (!state.positions.row(i).allFinite() || !state.velocities.row(i).allFinite() ||
        !state.accelerations.row(i).allFinite() || !state.jerks.row(i).allFinite())
      return i;
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
    : system_(&system), options_(options) {
  options.validate();
}

ImplicitMidpoint::~ImplicitMidpoint() = default;
ImplicitMidpoint::ImplicitMidpoint(ImplicitMidpoint&&) noexcept = default;

StepReport ImplicitMidpoint::step(MotionState& state, double dt) {
  const int n = system_->vertex_count();
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw Error(ErrorCode::configuration, fmt::format("the time step is {}; it must be above 0", dt));
  if (state.positions.rows() != n)
    throw Error(ErrorCode::configuration,
                fmt::format("{} positions for {} masses; give one per vertex", state.positions.rows(), n));
  state.complete(n);
  StepReport report;
  report.dt = dt;
  attempts_ = 0;
  report.converged = solve(state, dt, report);
  if (report.converged) {
    report.substeps = 1;
  } else if (const int bad = first_not_finite(state); bad >= 0) {
    report.reason = fmt::format("the motion of vertex {} is not finite before the step", bad);
  } else {
    MotionState next = state;
    report.converged = halve(next, dt, options_.max_halvings, report);
    if (report.converged) state = std::move(next);
  }
  if (report.converged) report.reason.clear();
  return report;
}

bool ImplicitMidpoint::halve(MotionState& state, double dt, int halvings_left, StepReport& report) {
  if (halvings_left == 0) return false;
  for (int part = 0; part < 2; ++part) {
    report.dt = std::min(report.dt, 0.5 * dt);
    if (attempts_++ == kMostSubsteps) {
      report.reason = fmt::format("given up after {} substeps; take a smaller dt", kMostSubsteps);
      return false;
    }
    if (solve(state, 0.5 * dt, report))
      ++report.substeps;
    else if (!halve(state, 0.5 * dt, halvings_left - 1, report))
      return false;
  }
  return true;
}

bool ImplicitMidpoint::solve(MotionState& state, double dt, StepReport& report) {
  if (solve_without_matrix(state, dt, report)) return true;
  if (newton_ == nullptr) newton_ = std::make_unique<detail::NewtonSolve>(*system_, options_);
  if (!newton_->run(state, dt, report)) return false;
  report.residual = std::max(report.residual, newton_->relative_residual());
  const Points3& d = newton_->displacement();
  for (int i = 0; i < d.rows(); ++i) {
    const Vec3 before = state.velocities.row(i).transpose();
    const Vec3 after = system_->pinned()[i] ? Vec3::Zero() : Vec3(2.0 / dt * d.row(i).transpose() - before);
    const Vec3 acceleration = (after - before) / dt;
    state.positions.row(i) += d.row(i);
    state.velocities.row(i) = after.transpose();
    state.jerks.row(i) = (acceleration.transpose() - state.accelerations.row(i)) / dt;
    state.accelerations.row(i) = acceleration.transpose();
  }
  return true;
}

bool ImplicitMidpoint::solve_without_matrix(MotionState& state, double dt, StepReport& report) {
  if (!system_->only_springs_and_loads()) return false;
  if (without_matrix_ == nullptr || without_matrix_->network() != system_->springs())
    without_matrix_ = std::make_unique<detail::ChebyshevMidpoint>(*system_->springs());
  system_->loads(state.positions, load_);
  const detail::ChebyshevReport solved =
      without_matrix_->solve(*system_, load_, state, dt, options_.tolerance);
  report.linear += solved.passes;
  if (solved.converged && solved.scale > 0.0)
    report.residual = std::max(report.residual, solved.residual / solved.scale);
  return solved.converged;
}

std::vector<StepReport> step_together(std::span<ImplicitMidpoint> steppers, std::span<MotionState> states,
                                      double dt) {
  detail::require_count("states", static_cast<Eigen::Index>(states.size()),
                        static_cast<Eigen::Index>(steppers.size()));
  std::vector<StepReport> reports(states.size());
  parallel_for(static_cast<int>(states.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) reports[k] = steppers[k].step(states[k], dt);
  });
  return reports;
}

}  // namespace wilt
