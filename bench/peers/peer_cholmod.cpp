// CHOLMOD: Newton's method with a supernodal factorisation, its analysis made once.
#include <Eigen/CholmodSupport>

#include "bench/peers/newton.hpp"

namespace wilt::bench {
namespace {

class Factorisation {
 public:
  explicit Factorisation(const SparseMatrix& pattern) { solver_.analyzePattern(pattern); }

  Eigen::VectorXd solve(const SparseMatrix& matrix, const Eigen::VectorXd& right) {
    solver_.factorize(matrix);
    return solver_.solve(right);
  }

 private:
  Eigen::CholmodSupernodalLLT<SparseMatrix> solver_;
};

void cholmod_step(benchmark::State& state, int vertices, double stiffness) {
  newton_step<Factorisation>(state, vertices, stiffness);
}
WILT_STEP_SCENARIO(cholmod_step, soft_1k, 1000, 4.0);
WILT_STEP_SCENARIO(cholmod_step, soft_10k, 10000, 4.0);
WILT_STEP_SCENARIO(cholmod_step, stiff_2k, 2000, 1000.0);
WILT_STEP_SCENARIO(cholmod_step, stiff_10k, 10000, 1000.0);

}  // namespace
}  // namespace wilt::bench
