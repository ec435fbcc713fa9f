// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) with 3 x 3 block-Jacobi.
#include <Eigen/LU>
#include <cmath>

#include "wilt/core/check.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/block_matrix.hpp"

namespace wilt {
namespace {

constexpr int kSumBlock = 3 * 4096;  // numbers per partial sum

// The inverse of every free diagonal block; 0 on pinned rows, which keeps them out of the iteration.
// False when a block is not positive definite.
bool invert_diagonal(const BlockMatrix& matrix, const std::vector<char>& pinned,
                     std::vector<Eigen::Matrix3d>& inverse) {
  inverse.resize(pinned.size());
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    inverse[i].setZero();
    if (pinned[i]) continue;
    const Eigen::Matrix3d block = matrix.block(matrix.pattern().diagonal(static_cast<int>(i)));
    const double minor = block(0, 0) * block(1, 1) - block(0, 1) * block(1, 0);
    if (!(block(0, 0) > 0.0) || !(minor > 0.0) || !(block.determinant() > 0.0)) return false;
    inverse[i] = block.inverse();
  }
  return true;
}

void precondition(const std::vector<Eigen::Matrix3d>& inverse, const Points3& r, Points3& z) {
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    z.row(row).transpose().noalias() = inverse[i] * r.row(row).transpose();
  }
}

void clear_pinned(const std::vector<char>& pinned, Points3& values) {
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    if (pinned[i]) values.row(static_cast<Eigen::Index>(i)).setZero();
  }
}

}  // namespace

double dot(const Points3& a, const Points3& b) {
  return parallel_sum(static_cast<int>(a.size()), kSumBlock, [&](int begin, int end) {
    return Eigen::Map<const Eigen::VectorXd>(a.data() + begin, end - begin)
        .dot(Eigen::Map<const Eigen::VectorXd>(b.data() + begin, end - begin));
  });
}

CgResult solve_cg(const BlockMatrix& matrix, const Points3& b, const std::vector<char>& pinned, double target,
                  int max_iterations, Points3& x) {
  WILT_CHECK(b.rows() == matrix.pattern().vertex_count(), b.rows(), matrix.pattern().vertex_count());
  CgResult result;
  x.setZero(b.rows(), 3);
  std::vector<Eigen::Matrix3d> inverse;
  if (!invert_diagonal(matrix, pinned, inverse)) {
    result.status = CgStatus::negative_curvature;
    return result;
  }
  Points3 r = b, z(b.rows(), 3), q(b.rows(), 3);
  clear_pinned(pinned, r);
  precondition(inverse, r, z);
  Points3 p = z;
  double rz = dot(r, z);
  result.residual = std::sqrt(dot(r, r));
  while (result.residual > target) {
    if (result.iterations == max_iterations) {
      result.status = CgStatus::max_iterations;
      break;
    }
    matrix.multiply(p, q);
    clear_pinned(pinned, q);
    const double curvature = dot(p, q);
    if (!(curvature > 0.0)) {
      result.status = CgStatus::negative_curvature;
      break;
    }
    const double step = rz / curvature;
    x += step * p;
    r -= step * q;
    precondition(inverse, r, z);
    const double rz_next = dot(r, z);
    p = z + (rz_next / rz) * p;
    rz = rz_next;
    result.residual = std::sqrt(dot(r, r));
    ++result.iterations;
  }
  return result;
}

}  // namespace wilt
