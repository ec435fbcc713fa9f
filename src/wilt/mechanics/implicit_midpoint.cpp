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

// Newton's method for one step. The matrix is kept for as long as the residual falls fast.
class NewtonSolve {
 public:
  NewtonSolve(const System& system, const MidpointOptions& options, BlockMatrix& matrix,
              const MotionState& start, double dt, StepReport& report)
      : system_(system), options_(options), matrix_(matrix), start_(start), dt_(dt), report_(report) {}

  bool run();  ///< false: the report says why
  const Points3& displacement() const { return d_; }
  double relative_residual() const { return scale_ > 0.0 ? current_.norm / scale_ : 0.0; }

 private:
  bool fail(const std::string& reason) {
    report_.reason = fmt::format("{} at a step of {}", reason, dt_);
    return false;
  }
  void build_matrix();
  CgResult solve_linear(Points3& delta);
  bool descend(const Points3& delta, bool shorten);

  const System& system_;
  const MidpointOptions& options_;
  BlockMatrix& matrix_;
  const MotionState& start_;
  const double dt_;
  StepReport& report_;

  Points3 d_;
  Residual current_;
  double scale_ = 0.0, target_ = 0.0;
  Curvature curvature_ = Curvature::exact;
  bool matrix_wanted_ = true;
};

bool NewtonSolve::run() {
  d_ = first_guess(system_, start_, dt_);
  current_.evaluate(system_, start_, d_, dt_);
  if (!std::isfinite(current_.norm)) return fail("a force is not finite where the iteration starts");
  scale_ = std::max(current_.force_scale, momentum_scale(system_, start_, dt_));
  target_ = std::max(options_.tolerance * scale_, round_off(system_, nullptr, start_.positions, dt_));

  Points3 delta;
  for (int iteration = 0; current_.norm > target_; ++iteration) {
    if (iteration == options_.max_newton)
      return fail(fmt::format("no convergence in {} iterations (residual {:.3g} of {:.3g})", iteration,
                              current_.norm, scale_));
    ++report_.newton;
    const bool fresh = matrix_wanted_;
    if (fresh) build_matrix();
    if (current_.norm <= target_) break;  // the matrix has told how large round-off is
    const CgResult linear = solve_linear(delta);
    if (linear.status != CgStatus::negative_curvature && descend(delta, fresh)) continue;
    // First a new matrix, then a semi-definite one, then a smaller time step.
    matrix_wanted_ = true;
    if (!fresh) continue;
    if (curvature_ == Curvature::semidefinite) return fail("no step along Newton's direction helps");
    curvature_ = Curvature::semidefinite;
  }
  return true;
}

void NewtonSolve::build_matrix() {
  system_.assemble(current_.position, current_.velocity, 0.25 * dt_ * dt_, 0.5 * dt_, curvature_, matrix_);
  target_ = std::max(options_.tolerance * scale_, round_off(system_, &matrix_, start_.positions, dt_));
  matrix_wanted_ = false;
}

CgResult NewtonSolve::solve_linear(Points3& delta) {
  const double factor = 0.5 * dt_ * dt_;  // R is a force, A a mass
  const double forcing = std::max(kForcing, 0.5 * target_ / current_.norm);
  const CgResult linear = solve_cg(matrix_, -factor * current_.values, system_.pinned(),
                                   forcing * factor * current_.norm, options_.max_linear, delta);
  report_.linear += linear.iterations;
  return linear;
}

// Goes along delta as far as the residual falls; without `shorten`, all the way or not at all.
bool NewtonSolve::descend(const Points3& delta, bool shorten) {
  Residual trial;
  double length = 1.0;
  for (int k = 0; k <= (shorten ? kMaxShortenings : 0); ++k, length *= 0.5) {
    Points3 trial_d = d_ + length * delta;
    trial.evaluate(system_, start_, trial_d, dt_);
    if (!std::isfinite(trial.norm) || trial.norm >= (1.0 - 1e-4 * length) * current_.norm) continue;
    matrix_wanted_ = trial.norm > kSlowReduction * current_.norm;
    d_ = std::move(trial_d);
    current_ = std::move(trial);
    return true;
  }
  return false;
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
  NewtonSolve newton(*system_, options_, matrix_, state, dt, report);
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
