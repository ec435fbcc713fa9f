#include "wilt/mechanics/block_matrix.hpp"

#include <algorithm>

#include "wilt/mechanics/single_blocks.hpp"

namespace wilt {

BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)),
      values_(detail::kBlockSize * static_cast<std::size_t>(pattern_->slot_count()) + detail::kBlockRoom) {}

void BlockMatrix::set_zero() {
  std::fill(values_.begin(), values_.end(), 0.0f);
}

void BlockMatrix::add(int slot, const Eigen::Matrix3d& block) {
  at(slot) += block.cast<float>();
  const int mirror = pattern_->mirror(slot);
  if (mirror != slot) at(mirror) += block.transpose().cast<float>();
}

void BlockMatrix::add_diagonal(int vertex, double value) {
  at(pattern_->diagonal(pattern_->row(vertex))).diagonal().array() += static_cast<float>(value);
}

Eigen::MatrixXd BlockMatrix::dense() const {
  const int n = pattern_->vertex_count();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int r = 0; r < n; ++r) {
    for (int s = pattern_->row_begin(r); s < pattern_->row_begin(r + 1); ++s)
      dense.block<3, 3>(3 * pattern_->vertex(r), 3 * pattern_->vertex(pattern_->column(s))) = block(s);
  }
  return dense;
}

}  // namespace wilt
