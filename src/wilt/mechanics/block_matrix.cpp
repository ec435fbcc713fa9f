#include "wilt/mechanics/block_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

constexpr int kRowGrain = 4096;  // rows per parallel task: below it the threads cost more than they bring

// The neighbours of each vertex, itself included, sorted.
std::vector<std::vector<int>> adjacency(int vertex_count, const std::vector<Stencil>& stencils) {
  std::vector<std::vector<int>> rows(vertex_count);
  for (int i = 0; i < vertex_count; ++i) rows[i].push_back(i);
  for (const Stencil& stencil : stencils) {
    for (int e = 0; e < stencil.rows(); ++e) {
      for (int a = 0; a < stencil.cols(); ++a) {
        const int i = stencil(e, a);
        if (i < 0 || i >= vertex_count)
          throw Error(
              ErrorCode::input,
              fmt::format("element {} uses vertex {}; there are {} vertices, from 0", e, i, vertex_count));
      }
      for (int a = 0; a < stencil.cols(); ++a) {
        for (int b = 0; b < stencil.cols(); ++b) {
          if (a != b) rows[stencil(e, a)].push_back(stencil(e, b));
        }
      }
    }
  }
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return rows;
}

}  // namespace

BlockPattern::BlockPattern(int vertex_count, const std::vector<Stencil>& stencils) {
  row_begin_.push_back(0);
  for (const auto& row : adjacency(vertex_count, stencils)) {
    column_.insert(column_.end(), row.begin(), row.end());
    row_begin_.push_back(static_cast<int>(column_.size()));
  }
  diagonal_.resize(vertex_count);
  mirror_.resize(column_.size());
  for (int i = 0; i < vertex_count; ++i) {
    diagonal_[i] = slot(i, i);
    for (int s = row_begin_[i]; s < row_begin_[i + 1]; ++s) mirror_[s] = slot(column_[s], i);
  }
}

int BlockPattern::slot(int i, int j) const {
  const auto begin = column_.begin() + row_begin_[i], end = column_.begin() + row_begin_[i + 1];
  const auto found = std::lower_bound(begin, end, j);
  return found == end || *found != j ? -1 : static_cast<int>(found - column_.begin());
}

Stencil BlockPattern::upper_slots(const Stencil& stencil) const {
  const int k = static_cast<int>(stencil.cols());
  Stencil slots(stencil.rows(), k * (k + 1) / 2);
  for (int e = 0; e < stencil.rows(); ++e) {
    int pair = 0;
    for (int a = 0; a < k; ++a) {
      for (int b = a; b < k; ++b) {
        const auto [low, high] = std::minmax({stencil(e, a), stencil(e, b)});
        slots(e, pair) = slot(low, high);
        WILT_CHECK(slots(e, pair) >= 0, low, high);
        ++pair;
      }
    }
  }
  return slots;
}

BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)), values_(9 * static_cast<std::size_t>(pattern_->slot_count()), 0.0) {}

void BlockMatrix::set_zero() {
  std::fill(values_.begin(), values_.end(), 0.0);
}

void BlockMatrix::finish() {
  parallel_for(pattern_->vertex_count(), kRowGrain, [this](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      for (int s = pattern_->row_begin(i); s < pattern_->diagonal(i); ++s)
        at(s) = block(pattern_->mirror(s)).transpose();
      const Eigen::Matrix3d own = block(pattern_->diagonal(i));
      at(pattern_->diagonal(i)) = 0.5 * (own + own.transpose());  // its terms are symmetric to round-off only
    }
  });
}

void BlockMatrix::multiply(const Points3& x, Points3& y) const {
  y.resize(x.rows(), 3);
  parallel_for(pattern_->vertex_count(), kRowGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      double y0 = 0.0, y1 = 0.0, y2 = 0.0;
      const int row_end = pattern_->row_begin(i + 1);
      for (int s = pattern_->row_begin(i); s < row_end; ++s) {
        const double* b = values_.data() + 9 * static_cast<std::size_t>(s);
        const double* v = x.data() + 3 * static_cast<std::size_t>(pattern_->column(s));
        y0 += b[0] * v[0] + b[3] * v[1] + b[6] * v[2];
        y1 += b[1] * v[0] + b[4] * v[1] + b[7] * v[2];
        y2 += b[2] * v[0] + b[5] * v[1] + b[8] * v[2];
      }
      double* out = y.data() + 3 * static_cast<std::size_t>(i);
      out[0] = y0, out[1] = y1, out[2] = y2;
    }
  });
}

Eigen::MatrixXd BlockMatrix::dense() const {
  const int n = pattern_->vertex_count();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i) {
    for (int s = pattern_->row_begin(i); s < pattern_->row_begin(i + 1); ++s)
      dense.block<3, 3>(3 * i, 3 * pattern_->column(s)) = block(s);
  }
  return dense;
}

}  // namespace wilt
