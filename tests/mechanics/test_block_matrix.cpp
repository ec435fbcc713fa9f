#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstring>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::Blade;

Eigen::Map<const VectorXd> flat(const Points3& x) {
  return {x.data(), x.size()};
}

BlockMatrix stiffness_matrix(const Blade& blade, double position_scale) {
  BlockMatrix matrix(blade.system->make_pattern());
  const Points3 v = Points3::Zero(blade.state.positions.rows(), 3);
  blade.system->assemble(blade.state.positions, v, position_scale, 0.05, Curvature::semidefinite, matrix);
  return matrix;
}

// Oracle: differential, against the dense matrix; round-off of sums of 39 terms.
TEST(BlockMatrix, MultipliesLikeTheDenseMatrixAndIsSymmetric) {
  const Blade blade = test::blade(6);
  const BlockMatrix matrix = stiffness_matrix(blade, 1.0);
  const MatrixXd dense = matrix.dense();
  EXPECT_EQ((dense - dense.transpose()).cwiseAbs().maxCoeff(), 0.0);
  Random random(3, "multiply");
  const Points3 x = test::random_points(49, 1.0, random);
  Points3 y;
  matrix.multiply(x, y);
  EXPECT_LT((dense * flat(x) - flat(y)).cwiseAbs().maxCoeff(), 1e-13 * dense.cwiseAbs().maxCoeff());
}

// Oracle: the definition, by brute force over the hinges and edges.
TEST(BlockPattern, HoldsExactlyThePairsThatShareAnElement) {
  const Blade blade = test::blade(4);
  const auto pattern = blade.system->make_pattern();
  const Stencil hinges = hinge_stencil(blade.shape.faces);
  Eigen::MatrixXi coupled = Eigen::MatrixXi::Identity(25, 25);
  for (int e = 0; e < blade.shape.edges.rows(); ++e) {
    const int i = blade.shape.edges(e, 0), j = blade.shape.edges(e, 1);
    coupled(i, j) = coupled(j, i) = 1;
  }
  for (int h = 0; h < hinges.rows(); ++h) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) coupled(hinges(h, a), hinges(h, b)) = 1;
    }
  }
  EXPECT_EQ(pattern->slot_count(), coupled.sum());
  for (int i = 0; i < 25; ++i) {
    for (int j = 0; j < 25; ++j) {
      const int slot = pattern->slot(i, j);
      ASSERT_EQ(slot >= 0, coupled(i, j) == 1) << i << " " << j;
      if (slot >= 0) {
        ASSERT_EQ(pattern->mirror(slot), pattern->slot(j, i));
      }
    }
  }
}

// Oracle: differential, against a dense factorisation of the free rows.
TEST(ConjugateGradients, SolveTheFreeRowsAndLeaveThePinned) {
  const Blade blade = test::blade(6);
  const BlockMatrix matrix = stiffness_matrix(blade, 0.5);
  const std::vector<char>& pinned = blade.system->pinned();
  MatrixXd dense = matrix.dense();
  Random random(4, "rhs");
  const Points3 b = test::random_points(49, 1.0, random);
  VectorXd rhs = flat(b);
  int count = 0;
  for (int i = 0; i < 49; ++i) {
    if (!pinned[i]) continue;
    ++count;
    for (int k = 3 * i; k < 3 * i + 3; ++k) {
      dense.row(k).setZero();
      dense.col(k).setZero();
      dense(k, k) = 1.0;
      rhs[k] = 0.0;
    }
  }
  ASSERT_GT(count, 0);
  const VectorXd expected = dense.llt().solve(rhs);
  Points3 x;
  const CgResult result = solve_cg(matrix, b, pinned, 1e-12, 500, x);
  EXPECT_EQ(result.status, CgStatus::converged);
  EXPECT_LE(result.residual, 1e-12);
  EXPECT_LT((flat(x) - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff());
}

// Oracle: a matrix with a negative eigenvalue by construction.
TEST(ConjugateGradients, ReportNegativeCurvature) {
  const Stencil edge = (Stencil(1, 2) << 0, 1).finished();
  const auto pattern = std::make_shared<const BlockPattern>(2, std::vector<Stencil>{edge});
  BlockMatrix matrix(pattern);
  matrix.add_diagonal(0, 1.0);
  matrix.add_diagonal(1, 1.0);
  matrix.add(pattern->slot(0, 1), 2.0 * Eigen::Matrix3d::Identity());  // eigenvalues 3 and -1
  matrix.finish();
  Points3 b(2, 3), x;
  b << 1, 0, 0, -1, 0, 0;
  EXPECT_EQ(solve_cg(matrix, b, {0, 0}, 1e-12, 100, x).status, CgStatus::negative_curvature);
}

// Oracle: differential, bytes on one and on two threads; large enough that work is divided.
TEST(ConjugateGradients, GiveTheSameBytesOnOneAndTwoThreads) {
  const Blade blade = test::blade(95);
  const BlockMatrix matrix = stiffness_matrix(blade, 0.01);
  Random random(5, "threads");
  const Points3 b = test::random_points(96 * 96, 1.0, random);
  Points3 x[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    solve_cg(matrix, b, blade.system->pinned(), 1e-6, 100, x[threads - 1]);
  }
  EXPECT_EQ(std::memcmp(x[0].data(), x[1].data(), sizeof(double) * x[0].size()), 0);
}

// Oracle: negative.
TEST(BlockPattern, RefusesAVertexThatIsNotThere) {
  EXPECT_THROW(BlockPattern(2, {(Stencil(1, 2) << 0, 2).finished()}), Error);
}

}  // namespace
}  // namespace wilt
