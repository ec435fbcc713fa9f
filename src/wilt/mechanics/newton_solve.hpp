// Steps of the implicit midpoint method by Newton's method (internal).
//
// Symbols: x0, v0 the state at the start, d = x1 - x0, R the residual, M the masses, A = dt^2/2 dR/dd the
// matrix.
#pragma once

#include <string>

#include "wilt/mechanics/conjugate_gradients.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"

namespace wilt::detail {

/// R(d) and where it was taken.
struct Residual {
  Points3 position, velocity;  // midpoint
  Points3 values;              // R, 0 on pinned vertices
  double norm = 0.0;
  double force_scale = 0.0;

  void evaluate(const System& system, const MotionState& start, const Points3& d, double dt);
};

/// Newton's method, inexact: each iteration's linear system is solved to a share of its residual, in single
/// precision, and the matrix is kept for as long as the residual falls fast. R itself and what it is compared
/// with are in double precision.
class NewtonSolve {
 public:
  /// `system` must outlive this.
  NewtonSolve(System& system, const MidpointOptions& options);
  NewtonSolve(const NewtonSolve&) = delete;
  NewtonSolve& operator=(const NewtonSolve&) = delete;

  /// One step. False: the report says why.
  bool run(const MotionState& start, double dt, StepReport& report);
  const Points3& displacement() const { return d_; }  ///< of the last step
  /// Of the force scale; where round-off sets the target, of the scale that makes it the tolerance.
  double relative_residual() const;

 private:
  bool fail(const std::string& reason);
  bool build_matrix();
  bool solve_linear();
  bool descend(bool shorten);

  const System& system_;
  const MidpointOptions options_;
  BlockMatrix matrix_;
  ConjugateGradients linear_;

  // Of the step that is under way.
  const MotionState* start_ = nullptr;
  StepReport* report_ = nullptr;
  Crew* crew_ = nullptr;
  double dt_ = 0.0, scale_ = 0.0, target_ = 0.0;
  Points3 d_, delta_;
  Residual current_, trial_;
  Curvature curvature_ = Curvature::exact;
  bool matrix_wanted_ = true;
};

}  // namespace wilt::detail
