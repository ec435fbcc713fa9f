// Implicit midpoint steps of many leaves of one topology.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wilt/mechanics/implicit_midpoint.hpp"

namespace wilt {

/// Steps systems of springs and loads on one and the same set of edges, eight side by side in the lanes of
/// the processor's vectors, and eights on several threads. Masses, coefficients, loads, pins and states are
/// each system's own, and what becomes of one does not depend on the others beside it.
///
/// What the lanes do not solve (chebyshev_midpoint.hpp) is stepped by ImplicitMidpoint alone. Its results and
/// these agree to the solver's tolerance. Deterministic on any number of threads.
class MidpointBatch {
 public:
  /// All terms must have been added to the systems, which must outlive this; no system may be given twice.
  /// Throws Error{configuration}, naming the system that has other edges than the first, or other terms than
  /// laws along them and loads.
  explicit MidpointBatch(const std::vector<System*>& systems, const MidpointOptions& options = {});
  ~MidpointBatch();

  /// Advances every state, one per system, by `dt` > 0. A state whose step fails is untouched, and its report
  /// says why. Throws Error{configuration} for another number of states, or a bad one.
  std::vector<StepReport> step(std::span<MotionState> states, double dt);

 private:
  struct Eight;
  void step_eight(Eight& eight, std::span<MotionState> states, double dt, std::vector<StepReport>& reports);

  std::vector<System*> systems_;
  MidpointOptions options_;
  std::vector<std::unique_ptr<Eight>> eights_;
};

}  // namespace wilt
