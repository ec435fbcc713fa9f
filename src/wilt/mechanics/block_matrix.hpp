// A symmetric sparse matrix of 3 x 3 blocks with a fixed pattern.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/block_pattern.hpp"

namespace wilt {

/// Values on a pattern, in single precision: the matrix steers Newton's iteration, it does not decide where
/// it ends.
class BlockMatrix {
 public:
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

  const BlockPattern& pattern() const { return *pattern_; }
  void set_zero();

  /// Adds to the block at `slot`, and the transposed block to its mirror.
  void add(int slot, const Eigen::Matrix3d& block);
  void add_diagonal(int vertex, double value);  ///< times the identity

  Eigen::Matrix3d block(int slot) const {
    return Eigen::Map<const Eigen::Matrix3f>(values(slot)).cast<double>();
  }

  /// All blocks, nine numbers each, column by column, and room for one more number behind the last.
  float* values() { return values_.data(); }
  const float* values() const { return values_.data(); }

  Eigen::MatrixXd dense() const;  ///< 3 #V x 3 #V by vertices, for tests and small systems

 private:
  const float* values(int slot) const { return values_.data() + 9 * static_cast<std::size_t>(slot); }
  Eigen::Map<Eigen::Matrix3f> at(int slot) {
    return Eigen::Map<Eigen::Matrix3f>(values_.data() + 9 * static_cast<std::size_t>(slot));
  }

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<float> values_;
};

}  // namespace wilt
