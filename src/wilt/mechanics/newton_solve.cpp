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
  norm = std::sqrt(dot(values, values));
}

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

bool NewtonSolve::fail(const std::string& reason) {
  report_.reason = fmt::format("{} at a step of {}", reason, dt_);
  return false;
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

}  // namespace wilt::detail
