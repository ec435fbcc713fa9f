// Eigen: Newton's method with conjugate gradients, diagonal preconditioner.
#include <Eigen/IterativeLinearSolvers>

#include "bench/peers/newton.hpp"

namespace wilt::bench {
namespace {

class DiagonalCg {
 public:
  explicit DiagonalCg(const SparseMatrix&) { solver_.setTolerance(1e-4); }

  Eigen::VectorXd solve(const SparseMatrix& matrix, const Eigen::VectorXd& right) {
    solver_.compute(matrix);
    return solver_.solve(right);
  }

 private:
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> solver_;
};

void eigen_step(benchmark::State& state, int vertices, double stiffness) {
  newton_step<DiagonalCg>(state, vertices, stiffness);
}
WILT_STEP_SCENARIOS(eigen_step);

}  // namespace
}  // namespace wilt::bench
