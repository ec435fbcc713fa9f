// The implicit midpoint step of a mass-dominated system of springs, without a matrix (internal).
#pragma once

#include <array>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/spring_network.hpp"
#include "wilt/mechanics/system.hpp"

namespace wilt::detail {

/// How a solve went. Residuals are norms of forces over the free vertices.
struct ChebyshevReport {
  bool converged = false;
  int passes = 0;  ///< evaluations of the forces
  double residual = 0.0, scale = 0.0;
};

/// A system of springs and loads, and its state (all vectors given) at the start of a step.
struct StepProblem {
  const System* system = nullptr;
  const Points3* load = nullptr;  ///< #V x 3
  MotionState* state = nullptr;
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
template <class Network>
class ChebyshevMidpoint {
 public:
  using Lanes = typename Network::Lanes;
  using Problems = std::array<StepProblem, Lanes::kLeaves>;
  using Reports = std::array<ChebyshevReport, Lanes::kLeaves>;

  /// `network` must outlive this.
  explicit ChebyshevMidpoint(const Network& network);

  const Network* network() const { return &network_; }

  /// One step of every problem, each by itself though side by side: what becomes of one does not depend on
  /// the others. A state is changed only when its report says converged; not even tried where the bounds
  /// promise no convergence in a reasonable number of passes. Deterministic on any number of threads.
  Reports solve(const Problems& problems, double dt, double tolerance);

 private:
  using Stored = typename Lanes::Stored;
  struct Spectrum {
    Number8 low, high;
  };
  struct Scales {
    Number8 force;      // S without the residual's share
    Number8 round_off;  // what one unit in the last place of every position does to R, per unit of spectrum
  };
  void combine(Crew& crew, double dt);
  Scales begin(Crew& crew, const Problems& problems);
  Spectrum spectrum(Crew& crew) const;
  void take_off_damping(Crew& crew);
  Number8 pass(Crew& crew, const Number8& alpha, const Number8& beta);
  void settle(const Mask8& lanes);
  void finish(Crew& crew, const Problems& problems, const Mask8& arrived) const;

  const Network& network_;
  int revision_ = -1;                               // of the network's stiffness, and
  double dt_ = 0.0;                                 // the step, that the next two belong to
  std::vector<Number8> pull_;                       // per slot: stretch + 2/dt damping
  std::vector<Number8> stretch_sum_, damping_sum_;  // per group: over the slots; the second times 2/dt
  std::vector<Number8> weight_, inertia_;     // per group: w = dt^2 / (4 m) and 1/w, both 0 where pinned
  std::vector<Stored> start_, u_, u_next_;    // x0, u and the u of the next pass
  std::vector<Stored> settled_;               // the solution
  std::vector<Point8> constant_, direction_;  // per group: r's part that does not depend on u, and p
};

}  // namespace wilt::detail
