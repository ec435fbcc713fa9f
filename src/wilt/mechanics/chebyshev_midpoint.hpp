// The implicit midpoint step of a mass-dominated system of springs, without a matrix (internal).
#pragma once

#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/spring_network.hpp"
#include "wilt/mechanics/system.hpp"

namespace wilt::detail {

/// How a solve went. Residuals are norms of forces over the free vertices.
struct ChebyshevReport {
  bool converged = false;
  int passes = 0;  ///< evaluations of the forces
  double residual = 0.0;
  double scale = 0.0;  ///< the tolerance times it is what the residual was to reach
};

/// Solves R(u) = 4 M/dt^2 (u - x0 - dt/2 v0) - F(u) = 0 for the midpoint u by Chebyshev's semi-iteration on
/// the nonlinear residual, preconditioned by the masses (Golub and Varga 1961; for springs Wang 2015):
///
///     r = -dt^2/4 M^-1 R(u),   p <- alpha r + beta p,   u <- u + p.
///
/// The spectrum of 1 - dt^2/4 M^-1 dF/du lies in [1 - low, 1 + high] with
///
///     high = max_i dt^2/(2 m_i) |sum_j stretch n n^T + (stretch - push/l)_+ (1 - n n^T) + 2/dt damping|,
///     low  = max_i dt^2/(2 m_i) sum_j (push/l - stretch)_+,
///
/// n an edge's direction, |.| the largest row sum. Where high is below a half, what it would be on a flat
/// leaf serves instead, and 0 for low: modes beyond these are damped all the same, only less. A pass
/// evaluates forces, residual, its norm and the update together; some four of them reduce R by 1e6 where high
/// is 0.2. Converged when ||R|| <= max(tolerance S, round-off), S the largest of the norms of 2 M v0/dt, of
/// the loads, of the last step's M a, and of R where the iteration starts.
class ChebyshevMidpoint {
 public:
  /// `network` must outlive this.
  explicit ChebyshevMidpoint(const SpringNetwork& network);

  const SpringNetwork* network() const { return &network_; }

  /// One step of `state` (all its vectors given) under the network's forces and `load` (#V x 3). The state is
  /// changed only when the report says converged; not even tried where the bounds promise no convergence in a
  /// reasonable number of passes. Deterministic on any number of threads.
  ChebyshevReport solve(const System& system, const Points3& load, MotionState& state, double dt,
                        double tolerance);

 private:
  struct Spectrum {
    double low, high;
  };
  struct Scales {
    double force;      // S without the residual's share
    double round_off;  // what one unit in the last place of every position does to R, per unit of spectrum
  };
  void combine(Crew& crew, double dt);
  Scales begin(Crew& crew, const System& system, const Points3& load, const MotionState& state, double dt);
  Spectrum spectrum(Crew& crew) const;
  void take_off_damping(Crew& crew);
  double pass(Crew& crew, double alpha, double beta);
  void finish(Crew& crew, MotionState& state, double dt) const;

  const SpringNetwork& network_;
  int revision_ = -1;                               // of the network's stiffness, and
  double dt_ = 0.0;                                 // the step, that the next three belong to
  std::vector<Number8> pull_;                       // per slot: stretch + 2/dt damping
  std::vector<Number8> stretch_sum_, damping_sum_;  // per group: over the slots; the second times 2/dt
  std::vector<Number8> weight_, inertia_;     // per group: w = dt^2 / (4 m) and 1/w, both 0 where pinned
  std::vector<Point4> start_, u_, u_next_;    // per row: x0, u and the u of the next pass
  std::vector<Point8> constant_, direction_;  // per group: r's part that does not depend on u, and p
};

}  // namespace wilt::detail
