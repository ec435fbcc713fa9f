// Watches a run for what no leaf does, so that it stops rather than go on into nonsense.
#pragma once

#include <string>

#include "wilt/core/types.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

/// How many times its rest length an edge may have after a step. Default runs reach 1.5 (cell) and 2.4
/// (paper). With every setting between half and twice its default cell reaches 2.4, and paper, whose springs
/// have no limit and whose modulus grows tenfold so, passes this in 3 runs of 100.
inline constexpr double kLargestStretch = 10.0;

/// The largest motion in a step, in leaf lengths: dt times the root mean square over the mass of the
/// velocities less their mean, so that a free leaf may fall. Default runs reach 0.002, those within a factor
/// of two 0.06.
inline constexpr double kLargestMotion = 0.5;

/// Looks at every step that has converged. What it says depends on the step alone, so that a run that is gone
/// on with is watched like one that was never left.
class Watchdog {
 public:
  /// `dt` the run's step, `tolerance` of the residual.
  Watchdog(double dt, double tolerance) : dt_(dt), tolerance_(tolerance) {}

  /// Why the leaf is not to be believed after a step, and what to do; empty: nothing is amiss. `max_strain`
  /// as in FrameMetrics, `v` #V x 3, `masses` #V. What is looked at: whether energies, residual and water are
  /// finite and the residual is within the tolerance; stretch and motion within the limits above. O(#V),
  /// deterministic.
  std::string complaint(const StepRow& row, double max_strain, const Points3& v,
                        const Eigen::VectorXd& masses) const;

 private:
  double dt_, tolerance_;
};

}  // namespace wilt
