// The implicit midpoint method: a step of any system of masses.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "wilt/mechanics/system.hpp"

namespace wilt {

namespace detail {
class ChebyshevMidpoint;
class NewtonSolve;
}  // namespace detail

struct MidpointOptions {
  double tolerance = 1e-8;  ///< of the residual, relative to the step's force scale, (0, 1)
  int max_newton = 30;      ///< Newton iterations before the step is halved, >= 1
  int max_linear = 500;     ///< conjugate-gradient iterations per Newton iteration, >= 1
  int max_halvings = 8;     ///< how often a step may be halved, [0, 30]

  void validate() const;  ///< throws Error{configuration}
};

/// How a step went.
struct StepReport {
  bool converged = true;  ///< false: the state is as it was before, `reason` says why
  std::string reason;     ///< empty when converged
  double dt = 0.0;        ///< the smallest step taken
  int substeps = 0;       ///< steps that the time was covered with; 1 when nothing was halved
  int newton = 0;         ///< Newton iterations, over all attempts; 0 where none was needed
  int linear = 0;         ///< conjugate-gradient iterations and passes without a matrix, over all attempts
  /// The largest of the accepted substeps, relative to max(S, round-off / tolerance): at most the tolerance.
  double residual = 0.0;
};

/// v1 = v0 + dt F((x0 + x1)/2, (v0 + v1)/2) / m,  x1 = x0 + dt/2 (v0 + v1)  (the paper's [23]; Hairer, Lubich
/// and Wanner).
///
/// The unknown is d = x1 - x0, the equation R(d) = M (2 d/dt^2 - 2 v0/dt) - F(x0 + d/2, d/dt) = 0 on the free
/// vertices; pinned ones keep their positions and have no velocity. Converged when ||R|| <= max(tolerance *
/// S, round-off), S the larger of ||2 M v0/dt|| and the norm of any single term's force where the iteration
/// starts; the round-off bound is what one unit in the last place of the positions changes R by.
///
/// A system of nothing but springs and loads is solved without a matrix where the masses dominate it, as in
/// the paper's model (chebyshev_midpoint.hpp). All else, and what does not converge so, is Newton's: each
/// step by conjugate gradients, first with the exact second derivatives, then with semi-definite ones where
/// these fail, and shortened until ||R|| falls. A step that does not converge is halved, up to `max_halvings`
/// times, and given up after a thousand substeps. Deterministic on any number of threads.
class ImplicitMidpoint {
 public:
  /// All terms must have been added to `system`, which must outlive this. Throws Error{configuration}.
  explicit ImplicitMidpoint(System& system, const MidpointOptions& options = {});
  ~ImplicitMidpoint();
  ImplicitMidpoint(ImplicitMidpoint&&) noexcept;

  /// Advances `state` by `dt` > 0. On failure the state is untouched and the report says why.
  StepReport step(MotionState& state, double dt);

 private:
  bool halve(MotionState& state, double dt, int halvings_left, StepReport& report);
  bool solve(MotionState& state, double dt, StepReport& report);
  bool solve_without_matrix(MotionState& state, double dt, StepReport& report);

  System* system_;
  MidpointOptions options_;
  std::unique_ptr<detail::ChebyshevMidpoint> without_matrix_;  // made when first needed
  std::unique_ptr<detail::NewtonSolve> newton_;                // the same
  Points3 load_;
  int attempts_ = 0;  // at substeps of the step under way
};

/// Steps many systems, leaves of a batch: `states` one per stepper, each as stepper.step(state, dt) would,
/// several at once. Small systems gain more so than from several threads in one step. Throws
/// Error{configuration} for another number of states, and as step does.
std::vector<StepReport> step_together(std::span<ImplicitMidpoint> steppers, std::span<MotionState> states,
                                      double dt);

}  // namespace wilt
