// Conjugate gradients with symmetric Gauss-Seidel, on the free rows of a block matrix.
#pragma once

#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mechanics/block_matrix.hpp"
#include "wilt/mechanics/single_blocks.hpp"

namespace wilt {

namespace detail {
struct SweptRows;
}

enum class CgStatus { converged, max_iterations, negative_curvature };

struct CgResult {
  CgStatus status = CgStatus::converged;
  int iterations = 0;
};

/// Solves A x = b in single precision, x = 0 on pinned rows. Takes some 2.3 times fewer iterations than with
/// the inverse diagonal blocks as the preconditioner, each as dear as one product with A.
///
/// A = L + D + L^T by blocks, preconditioned with (D + L) D^-1 (D + L^T): symmetric Gauss-Seidel, by
/// Eisenstat's way (1981) of iterating on (D + L)^-1 A (D + L^T)^-1, whose product with p is t + (D + L)^-1
/// (p - D t), t = (D + L^T)^-1 p. The rows of a colour are swept at once. Sums are taken in fixed blocks of
/// rows: the same bytes on any number of threads.
class ConjugateGradients {
 public:
  /// `matrix` must outlive this; `pinned` #V flags.
  ConjugateGradients(const BlockMatrix& matrix, const std::vector<char>& pinned);

  /// Takes over the matrix's present values. False when a free diagonal block is not positive definite: then
  /// solve must not be called.
  bool prepare();

  /// From x = 0 until the residual's norm in the inverse of the preconditioner has fallen by the factor
  /// `reduction`, not below some 1e-6. `b` #V x 3; what stands on pinned rows is of no account. Stops with
  /// negative_curvature when A shows itself not positive definite; x is then the last iterate.
  CgResult solve(const Points3& b, double reduction, int max_iterations, Crew& crew, Points3& x);

 private:
  struct Task {
    int begin, end;  // rows of one colour
  };

  detail::SweptRows swept_rows();
  template <class Sweep>
  double run(int begin, int end, Crew& crew, const Sweep& sweep);
  double start(Crew& crew);
  double multiply(float beta, Crew& crew);

  const BlockMatrix* matrix_;
  std::vector<char> free_;         // per row
  std::vector<Task> tasks_;        // ascending
  std::vector<int> colour_tasks_;  // per colour its first task; the end
  std::vector<double> partial_;    // per task
  std::vector<float> inverse_;     // D^-1; 0 on pinned rows, which keeps them out
  std::vector<detail::SinglePoint> x_, r_, z_, p_, q_, t_;
};

}  // namespace wilt
