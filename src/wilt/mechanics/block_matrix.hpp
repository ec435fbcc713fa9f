// A symmetric sparse matrix of 3 x 3 blocks with a fixed pattern, and conjugate gradients on it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// Rows of vertices that a kind of element couples: #elements x (vertices per element).
using Stencil = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Which blocks a matrix has. Immutable; every diagonal block is there. Slots count blocks row by row.
class BlockPattern {
 public:
  /// All pairs of vertices that share an element of a stencil. O(#pairs log #pairs). Throws Error{input} for
  /// an index outside [0, vertex_count).
  BlockPattern(int vertex_count, const std::vector<Stencil>& stencils);

  int vertex_count() const { return static_cast<int>(diagonal_.size()); }
  int slot_count() const { return static_cast<int>(column_.size()); }
  int row_begin(int i) const { return row_begin_[i]; }  ///< the first slot of row i; row_begin(#V) is the end
  int column(int slot) const { return column_[slot]; }
  int diagonal(int i) const { return diagonal_[i]; }    ///< the slot of block (i, i)
  int mirror(int slot) const { return mirror_[slot]; }  ///< the slot of the transposed block
  int slot(int i, int j) const;  ///< of block (i, j); -1 when there is none. O(log row)

  /// Per element, the slots of the pairs (a, b), a <= b in the element's order, each in the upper triangle of
  /// the matrix (the lower vertex is the row). #elements x k (k + 1) / 2.
  Stencil upper_slots(const Stencil& stencil) const;

 private:
  std::vector<int> row_begin_, column_, diagonal_, mirror_;
};

/// Values on a pattern. Filled in the upper triangle only; `finish` copies it to the lower one.
class BlockMatrix {
 public:
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

  const BlockPattern& pattern() const { return *pattern_; }
  void set_zero();

  /// Adds to the block at `slot` (of the upper triangle, as upper_slots gives it).
  void add(int slot, const Eigen::Matrix3d& block) { at(slot) += block; }
  void add_diagonal(int i, double value) { at(pattern_->diagonal(i)).diagonal().array() += value; }

  /// Mirrors the upper triangle into the lower one; call once, after filling.
  void finish();

  Eigen::Map<const Eigen::Matrix3d> block(int slot) const {
    return Eigen::Map<const Eigen::Matrix3d>(values_.data() + 9 * static_cast<std::size_t>(slot));
  }

  /// y = A x, #V x 3 each. Parallel over rows; the same bytes on any number of threads.
  void multiply(const Points3& x, Points3& y) const;

  Eigen::MatrixXd dense() const;  ///< 3 #V x 3 #V, for tests and small systems

 private:
  Eigen::Map<Eigen::Matrix3d> at(int slot) {
    return Eigen::Map<Eigen::Matrix3d>(values_.data() + 9 * static_cast<std::size_t>(slot));
  }

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> values_;  // 9 per slot, column-major
};

enum class CgStatus { converged, max_iterations, negative_curvature };

struct CgResult {
  CgStatus status = CgStatus::converged;
  int iterations = 0;
  double residual = 0.0;  ///< ||b - A x|| over the free rows, by the recurrence
};

/// Solves A x = b on the rows that are not pinned (x is 0 on the others), from x = 0, by conjugate gradients
/// preconditioned with the inverse 3 x 3 diagonal blocks, until the residual is at most `target` (absolute).
///
/// Stops with negative_curvature when A shows itself not positive definite; x is then the last iterate.
/// `pinned`: #V flags. Sums are taken in fixed blocks: deterministic on any number of threads.
CgResult solve_cg(const BlockMatrix& matrix, const Points3& b, const std::vector<char>& pinned, double target,
                  int max_iterations, Points3& x);

/// sum_i a_i . b_i in fixed blocks.
double dot(const Points3& a, const Points3& b);

}  // namespace wilt
