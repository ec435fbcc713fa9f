#include "wilt/mechanics/implicit_midpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/newton_solve.hpp"

namespace wilt {
namespace {

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
  detail::NewtonSolve newton(*system_, options_, matrix_, state, dt, report);
  if (!newton.run()) return false;
  report.residual = std::max(report.residual, newton.relative_residual());
  const Points3& d = newton.displacement();
  for (int i = 0; i < d.rows(); ++i) {
    const Vec3 before = state.velocities.row(i).transpose();
    const Vec3 after = system_->pinned()[i] ? Vec3::Zero() : Vec3(2.0 / dt * d.row(i).transpose() - before);
    state.positions.row(i) += d.row(i);
    state.velocities.row(i) = after.transpose();
    state.accelerations.row(i) = (after - before).transpose() / dt;
  }
  return true;
}

}  // namespace wilt
