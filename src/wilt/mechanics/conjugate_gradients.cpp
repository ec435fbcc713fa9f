// Symbols as in Eisenstat (1981): r the residual of the preconditioned system, z = D r, p the direction, t =
// (D + L^T)^-1 p, w = (D + L)^-1 (p - D t), q = t + w; x follows t.
#include "wilt/mechanics/conjugate_gradients.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "wilt/core/check.hpp"

namespace wilt {
namespace detail {

struct SweptRows {
  const int *row_begin, *diagonal, *columns;
  const float *blocks, *inverse;
  SinglePoint *x, *r, *z, *p, *q, *t;
};

namespace {

constexpr int kTaskRows = 256;

WILT_INLINE double sum3(Single4 v) {
  return static_cast<double>(v[0]) + static_cast<double>(v[1]) + static_cast<double>(v[2]);
}

// r <- (D + L)^-1 r, z = D r, x = p = 0. Returns r . z.
WILT_CLONES double start_rows(const SweptRows& k, int begin, int end) {
  Single4 rz{};
  for (int i = begin; i < end; ++i) {
    const Single4 lower = times_row(k.blocks, k.columns, k.row_begin[i], k.diagonal[i], k.r);
    const Single4 r = times(k.inverse, i, k.r[i].xyz - lower);
    const Single4 z = times(k.blocks, k.diagonal[i], r);
    k.r[i].xyz = r;
    k.z[i].xyz = z;
    k.x[i].xyz = k.p[i].xyz = Single4{};
    rz += r * z;
  }
  return sum3(rz);
}

// p <- z + beta p, t = (D + L^T)^-1 p, q = p - D t.
WILT_CLONES void sweep_backward(const SweptRows& k, float beta, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const Single4 p = k.z[i].xyz + beta * k.p[i].xyz;
    const Single4 upper = times_row(k.blocks, k.columns, k.diagonal[i] + 1, k.row_begin[i + 1], k.t);
    k.p[i].xyz = p;
    k.q[i].xyz = upper;
    k.t[i].xyz = times(k.inverse, i, p - upper);
  }
}

// w = (D + L)^-1 q in the place of z, q = t + w. Returns p . q.
WILT_CLONES double sweep_forward(const SweptRows& k, int begin, int end) {
  Single4 pq{};
  for (int i = begin; i < end; ++i) {
    const Single4 lower = times_row(k.blocks, k.columns, k.row_begin[i], k.diagonal[i], k.z);
    const Single4 w = times(k.inverse, i, k.q[i].xyz - lower);
    const Single4 q = k.t[i].xyz + w;
    k.z[i].xyz = w;
    k.q[i].xyz = q;
    pq += k.p[i].xyz * q;
  }
  return sum3(pq);
}

// x += alpha t, r -= alpha q, z = D r. Returns r . z.
WILT_CLONES double update_rows(const SweptRows& k, float alpha, int begin, int end) {
  Single4 rz{};
  for (int i = begin; i < end; ++i) {
    const Single4 r = k.r[i].xyz - alpha * k.q[i].xyz;
    const Single4 z = times(k.blocks, k.diagonal[i], r);
    k.x[i].xyz += alpha * k.t[i].xyz;
    k.r[i].xyz = r;
    k.z[i].xyz = z;
    rz += r * z;
  }
  return sum3(rz);
}

// The inverse of a positive definite block; false when it is not.
bool invert(const Eigen::Matrix3d& block, float* inverse) {
  const double minor = block(0, 0) * block(1, 1) - block(0, 1) * block(1, 0);
  const double determinant = block.determinant();
  if (!(block(0, 0) > 0.0) || !(minor > 0.0) || !(determinant > 0.0) || !std::isfinite(determinant))
    return false;
  const Eigen::Matrix3f single = block.inverse().cast<float>();
  std::copy_n(single.data(), kBlockSize, inverse);
  return true;
}

}  // namespace
}  // namespace detail

ConjugateGradients::ConjugateGradients(const BlockMatrix& matrix, const std::vector<char>& pinned)
    : matrix_(&matrix) {
  const BlockPattern& pattern = matrix.pattern();
  const int n = pattern.vertex_count();
  WILT_CHECK(static_cast<int>(pinned.size()) == n, pinned.size(), n);
  for (int row = 0; row < n; ++row) free_.push_back(!pinned[pattern.vertex(row)]);
  for (int c = 0; c < pattern.colour_count(); ++c) {
    colour_tasks_.push_back(static_cast<int>(tasks_.size()));
    const int end = pattern.colour_begin(c + 1);
    for (int begin = pattern.colour_begin(c); begin < end; begin += detail::kTaskRows)
      tasks_.push_back({begin, std::min(end, begin + detail::kTaskRows)});
  }
  colour_tasks_.push_back(static_cast<int>(tasks_.size()));
  partial_.resize(tasks_.size());
  inverse_.resize(detail::kBlockSize * static_cast<std::size_t>(n) + detail::kBlockRoom);
  for (auto* vector : {&x_, &r_, &z_, &p_, &q_, &t_}) vector->resize(n);
}

bool ConjugateGradients::prepare() {
  const BlockPattern& pattern = matrix_->pattern();
  for (int i = 0; i < pattern.vertex_count(); ++i) {
    if (free_[i] && !detail::invert(matrix_->block(pattern.diagonal(i)),
                                    inverse_.data() + detail::kBlockSize * static_cast<std::size_t>(i)))
      return false;
  }
  return true;
}

detail::SweptRows ConjugateGradients::swept_rows() {
  const BlockPattern& pattern = matrix_->pattern();
  return {pattern.row_begins(),
          pattern.diagonals(),
          pattern.columns(),
          matrix_->values(),
          inverse_.data(),
          x_.data(),
          r_.data(),
          z_.data(),
          p_.data(),
          q_.data(),
          t_.data()};
}

// sweep(first row, last row) over the tasks [begin, end); the sum of what it returns.
template <class Sweep>
double ConjugateGradients::run(int begin, int end, Crew& crew, const Sweep& sweep) {
  const auto task = [&](int k) {
    const Task& rows = tasks_[begin + k];
    partial_[begin + k] = sweep(rows.begin, rows.end);
  };
  crew.for_each(end - begin, std::cref(task));
  double sum = 0.0;
  for (int k = begin; k < end; ++k) sum += partial_[k];
  return sum;
}

double ConjugateGradients::start(Crew& crew) {
  const detail::SweptRows rows = swept_rows();
  double rz = 0.0;
  for (std::size_t c = 0; c + 1 < colour_tasks_.size(); ++c)
    rz += run(colour_tasks_[c], colour_tasks_[c + 1], crew,
              [&](int begin, int end) { return detail::start_rows(rows, begin, end); });
  return rz;
}

// The new direction and its product; returns p . q.
double ConjugateGradients::multiply(float beta, Crew& crew) {
  const detail::SweptRows rows = swept_rows();
  const int colours = static_cast<int>(colour_tasks_.size()) - 1;
  for (int c = colours - 1; c >= 0; --c)
    run(colour_tasks_[c], colour_tasks_[c + 1], crew, [&](int begin, int end) {
      detail::sweep_backward(rows, beta, begin, end);
      return 0.0;
    });
  double pq = 0.0;
  for (int c = 0; c < colours; ++c)
    pq += run(colour_tasks_[c], colour_tasks_[c + 1], crew,
              [&](int begin, int end) { return detail::sweep_forward(rows, begin, end); });
  return pq;
}

CgResult ConjugateGradients::solve(const Points3& b, double reduction, int max_iterations, Crew& crew,
                                   Points3& x) {
  const BlockPattern& pattern = matrix_->pattern();
  const int n = pattern.vertex_count();
  WILT_CHECK(b.rows() == n, b.rows(), n);
  CgResult result;
  x.setZero(n, 3);
  const double scale = b.cwiseAbs().maxCoeff();  // keeps squares within single precision
  if (scale == 0.0) return result;
  for (int i = 0; i < n; ++i) {
    const double* from = b.data() + 3 * static_cast<std::ptrdiff_t>(pattern.vertex(i));
    for (int k = 0; k < 3; ++k) r_[i].xyz[k] = static_cast<float>(from[k] / scale);
  }
  double rz = start(crew);
  const double target = reduction * reduction * rz;
  double beta = 0.0;
  while (rz > target) {
    if (result.iterations == max_iterations) {
      result.status = CgStatus::max_iterations;
      break;
    }
    const double pq = multiply(static_cast<float>(beta), crew);
    if (!(pq > 0.0)) {
      result.status = CgStatus::negative_curvature;
      break;
    }
    const detail::SweptRows rows = swept_rows();
    const float alpha = static_cast<float>(rz / pq);
    const double rz_next = run(0, static_cast<int>(tasks_.size()), crew, [&](int begin, int end) {
      return detail::update_rows(rows, alpha, begin, end);
    });
    beta = rz_next / rz;
    rz = rz_next;
    ++result.iterations;
  }
  for (int i = 0; i < n; ++i) {
    double* to = x.data() + 3 * static_cast<std::ptrdiff_t>(pattern.vertex(i));
    for (int k = 0; k < 3; ++k) to[k] = scale * static_cast<double>(x_[i].xyz[k]);
  }
  return result;
}

}  // namespace wilt
