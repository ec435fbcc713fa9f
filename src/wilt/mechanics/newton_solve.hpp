// One step of the implicit midpoint method by Newton's method (internal).
//
// Symbols: x0, v0 the state at the start, d = x1 - x0, R the residual, M the masses, A = dt^2/2 dR/dd the
// matrix.
#pragma once

#include <string>

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

/// Newton's method for one step. The matrix is kept for as long as the residual falls fast.
class NewtonSolve {
 public:
  NewtonSolve(const System& system, const MidpointOptions& options, BlockMatrix& matrix,
              const MotionState& start, double dt, StepReport& report)
      : system_(system), options_(options), matrix_(matrix), start_(start), dt_(dt), report_(report) {}

  bool run();  ///< false: the report says why
  const Points3& displacement() const { return d_; }
  double relative_residual() const { return scale_ > 0.0 ? current_.norm / scale_ : 0.0; }

 private:
  bool fail(const std::string& reason);
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

}  // namespace wilt::detail
