#include "wilt/mechanics/newton_solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wilt::detail {
namespace {

constexpr double kForcing = 0.02;       // a linear solve reduces its residual by this factor
constexpr double kSlowReduction = 0.1;  // an iteration that reduces less than this calls for a new matrix
constexpr int kMaxShortenings = 12;     // halvings of a Newton step
constexpr double kRoundOff = 8.0 * std::numeric_limits<double>::epsilon();

double momentum_scale(const System& system, const MotionState& state, double dt) {
  double sum = 0.0;
  for (int i = 0; i < state.velocities.rows(); ++i)
    sum += std::pow(2.0 * system.masses()[i] / dt, 2) * state.velocities.row(i).squaredNorm();
  return std::sqrt(sum);
}

double mean_diagonal(const BlockMatrix& matrix, int vertex) {
  const BlockPattern& pattern = matrix.pattern();
  return matrix.block(pattern.diagonal(pattern.row(vertex))).trace() / 3.0;
}

// What one unit in the last place of every position does to R.
double round_off(const System& system, const BlockMatrix* matrix, const Points3& x, double dt) {
  double sum = 0.0;
  for (int i = 0; i < x.rows(); ++i) {
    if (system.pinned()[i]) continue;
    const double diagonal = matrix ? mean_diagonal(*matrix, i) : system.masses()[i];
    sum += diagonal * diagonal * x.row(i).squaredNorm();
  }
  return kRoundOff * 2.0 / (dt * dt) * std::sqrt(sum);
}

// With d', d'' the displacements of the last two steps, d' + (d' - d'')/2: half way between going on as in
// the last step and going on as straight. Stiff vertices swing to and fro about where they balance, from step
// to step, and a bolder guess would follow their last swing.
Points3 first_guess(const System& system, const MotionState& state, double dt) {
  Points3 d = dt * state.velocities - 0.25 * dt * dt * dt * state.jerks;
  for (int i = 0; i < d.rows(); ++i) {
    if (system.pinned()[i]) d.row(i).setZero();
  }
  return d;
}

}  // namespace

void Residual::evaluate(const System& system, const MotionState& start, const Points3& d, double dt) {
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
  norm = values.norm();
}

NewtonSolve::NewtonSolve(System& system, const MidpointOptions& options)
    : system_(system), options_(options), matrix_(system.make_pattern()), linear_(matrix_, system.pinned()) {}

bool NewtonSolve::run(const MotionState& start, double dt, StepReport& report) {
  Crew crew;
  start_ = &start, dt_ = dt, report_ = &report, crew_ = &crew;
  curvature_ = Curvature::exact;
  matrix_wanted_ = true;
  d_ = first_guess(system_, start, dt);
  current_.evaluate(system_, start, d_, dt);
  if (!std::isfinite(current_.norm)) return fail("a force is not finite where the iteration starts");
  scale_ = std::max(current_.force_scale, momentum_scale(system_, start, dt));
  target_ = std::max(options_.tolerance * scale_, round_off(system_, nullptr, start.positions, dt));

  for (int iteration = 0; current_.norm > target_; ++iteration) {
    if (iteration == options_.max_newton)
      return fail(fmt::format("no convergence in {} iterations (residual {:.3g} of {:.3g})", iteration,
                              current_.norm, scale_));
    ++report.newton;
    const bool fresh = matrix_wanted_;
    const bool usable = !fresh || build_matrix();
    if (current_.norm <= target_) break;  // the matrix has told how large round-off is
    if (usable && solve_linear() && descend(fresh)) continue;
    // First a new matrix, then a semi-definite one, then a smaller time step.
    matrix_wanted_ = true;
    if (!fresh) continue;
    if (curvature_ == Curvature::semidefinite) return fail("no step along Newton's direction helps");
    curvature_ = Curvature::semidefinite;
  }
  return true;
}

double NewtonSolve::relative_residual() const {
  const double scale = target_ > options_.tolerance * scale_ ? target_ / options_.tolerance : scale_;
  return scale > 0.0 ? current_.norm / scale : 0.0;
}

bool NewtonSolve::fail(const std::string& reason) {
  report_->reason = fmt::format("{} at a step of {}", reason, dt_);
  return false;
}

// False when the matrix is seen not to be positive definite.
bool NewtonSolve::build_matrix() {
  system_.assemble(current_.position, current_.velocity, 0.25 * dt_ * dt_, 0.5 * dt_, curvature_, matrix_);
  target_ = std::max(options_.tolerance * scale_, round_off(system_, &matrix_, start_->positions, dt_));
  matrix_wanted_ = false;
  return linear_.prepare();
}

// False when the matrix is not positive definite.
bool NewtonSolve::solve_linear() {
  const double factor = 0.5 * dt_ * dt_;  // R is a force, A a mass
  const double forcing = std::max(kForcing, 0.5 * target_ / current_.norm);
  const CgResult result =
      linear_.solve(-factor * current_.values, forcing, options_.max_linear, *crew_, delta_);
  report_->linear += result.iterations;
  return result.status != CgStatus::negative_curvature;
}

// Goes along delta as far as the residual falls; without `shorten`, all the way or not at all.
bool NewtonSolve::descend(bool shorten) {
  double length = 1.0;
  for (int k = 0; k <= (shorten ? kMaxShortenings : 0); ++k, length *= 0.5) {
    const Points3 d = d_ + length * delta_;
    trial_.evaluate(system_, *start_, d, dt_);
    if (!std::isfinite(trial_.norm) || trial_.norm >= (1.0 - 1e-4 * length) * current_.norm) continue;
    matrix_wanted_ = trial_.norm > kSlowReduction * current_.norm;
    d_ = d;
    std::swap(current_, trial_);
    return true;
  }
  return false;
}

}  // namespace wilt::detail
