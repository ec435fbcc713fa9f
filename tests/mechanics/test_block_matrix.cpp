#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>

#include "mechanics/fixtures.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/conjugate_gradients.hpp"

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

// Oracle: differential, against the terms' own blocks one by one, in the doubles of which single precision
// keeps 6e-8.
TEST(System, AssemblesTheLawsAlongEdgesAsTheirTermsWould) {
  const Blade blade = test::blade(5);
  const int edges = static_cast<int>(blade.shape.edges.rows());
  Random random(8, "laws");
  const Points3 x = blade.state.positions + test::random_points(36, 0.3, random);
  Eigen::MatrixX2d pushes(edges, 2);
  for (int k = 0; k < pushes.size(); ++k) pushes.data()[k] = random.uniform(-0.5, 0.5);
  const VectorXd rest = test::lengths(blade.shape.edges, blade.shape.positions);
  for (const Curvature curvature : {Curvature::exact, Curvature::semidefinite}) {
    System system(VectorXd::Constant(36, 0.5), std::vector<char>(36, 0));
    std::vector<Force*> forces;
    Springs& springs = system.add_energy(
        "springs", std::make_unique<Springs>(blade.shape.edges, rest, VectorXd::Constant(edges, 4.0)));
    forces.push_back(&system.add_force(
        "damping", std::make_unique<EdgeDamping>(blade.shape.edges, VectorXd::Constant(edges, 0.2))));
    if (curvature == Curvature::exact)  // semi-definite, a push cannot be told from a spring under pressure
      forces.push_back(
          &system.add_force("swelling", std::make_unique<OneSidedSwelling>(blade.shape.edges, pushes)));
    const auto pattern = system.make_pattern();
    BlockMatrix together(pattern), apart(pattern);
    system.assemble(x, x, 0.7, 0.3, curvature, together);
    for (int i = 0; i < 36; ++i) apart.add_diagonal(i, 0.5);
    springs.add_hessian(x, apart, 0.7, curvature);
    for (const Force* force : forces) force->add_jacobian(x, x, apart, 0.7, 0.3, curvature);
    EXPECT_LT((together.dense() - apart.dense()).cwiseAbs().maxCoeff(),
              1e-6 * apart.dense().cwiseAbs().maxCoeff());
  }
}

CgResult solve(const BlockMatrix& matrix, const Points3& b, const std::vector<char>& pinned, double reduction,
               Points3& x) {
  ConjugateGradients solver(matrix, pinned);
  EXPECT_TRUE(solver.prepare());
  Crew crew;
  return solver.solve(b, reduction, 500, crew, x);
}

// Oracle: the definition of a symmetric matrix; the same additions in the same order on both sides.
TEST(BlockMatrix, IsSymmetricToTheLastBit) {
  const Blade blade = test::blade(6);
  const MatrixXd dense = stiffness_matrix(blade, 1.0).dense();
  EXPECT_GT(dense.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ((dense - dense.transpose()).cwiseAbs().maxCoeff(), 0.0);
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

// Oracle: the definition of a colouring, and that every vertex has one row.
TEST(BlockPattern, CouplesNoTwoRowsOfAColour) {
  const auto pattern = test::blade(9).system->make_pattern();
  std::vector<int> colour(100), rows_of(100, 0);
  for (int c = 0; c < pattern->colour_count(); ++c) {
    for (int row = pattern->colour_begin(c); row < pattern->colour_begin(c + 1); ++row) colour[row] = c;
  }
  for (int row = 0; row < 100; ++row) {
    ++rows_of[pattern->vertex(row)];
    ASSERT_EQ(pattern->row(pattern->vertex(row)), row);
    for (int s = pattern->row_begin(row); s < pattern->row_begin(row + 1); ++s) {
      if (s != pattern->diagonal(row)) {
        ASSERT_NE(colour[pattern->column(s)], colour[row]) << "row " << row;
      }
    }
  }
  EXPECT_EQ(rows_of, std::vector<int>(100, 1));
}

// Oracle: differential, against a dense factorisation of the free rows. The solver works in single precision
// (6e-8) on a matrix whose condition is some tens.
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
  const CgResult result = solve(matrix, b, pinned, 1e-6, x);
  EXPECT_EQ(result.status, CgStatus::converged);
  EXPECT_GT(result.iterations, 1);
  EXPECT_LT((flat(x) - expected).cwiseAbs().maxCoeff(), 1e-5 * expected.cwiseAbs().maxCoeff());
}

// Oracle: scaling of the right side by a power of two scales every number on the way, also where its squares
// leave the range of single precision.
TEST(ConjugateGradients, ScaleWithTheRightSide) {
  const Blade blade = test::blade(6);
  const BlockMatrix matrix = stiffness_matrix(blade, 0.5);
  Random random(4, "scale");
  const Points3 b = test::random_points(49, 1.0, random);
  Points3 x, small;
  solve(matrix, b, blade.system->pinned(), 1e-4, x);
  const double factor = std::ldexp(1.0, -200);
  solve(matrix, factor * b, blade.system->pinned(), 1e-4, small);
  EXPECT_EQ(small, factor * x);
}

// Oracle: a matrix with a negative eigenvalue by construction.
TEST(ConjugateGradients, ReportNegativeCurvature) {
  const Stencil edge = (Stencil(1, 2) << 0, 1).finished();
  const auto pattern = std::make_shared<const BlockPattern>(2, std::vector<Stencil>{edge});
  BlockMatrix matrix(pattern);
  matrix.add_diagonal(0, 1.0);
  matrix.add_diagonal(1, 1.0);
  matrix.add(pattern->slot(0, 1), 2.0 * Eigen::Matrix3d::Identity());  // eigenvalues 3 and -1
  Points3 b(2, 3), x;
  b << 1, 0, 0, -1, 0, 0;
  EXPECT_EQ(solve(matrix, b, {0, 0}, 1e-6, x).status, CgStatus::negative_curvature);
}

// Oracle: a diagonal block with a negative entry by construction.
TEST(ConjugateGradients, RefuseADiagonalThatIsNotPositive) {
  const auto pattern = std::make_shared<const BlockPattern>(1, std::vector<Stencil>{});
  BlockMatrix matrix(pattern);
  matrix.add(0, Vec3(1.0, -1.0, 1.0).asDiagonal().toDenseMatrix());
  EXPECT_FALSE(ConjugateGradients(matrix, {0}).prepare());
  EXPECT_TRUE(ConjugateGradients(matrix, {1}).prepare());  // pinned: of no account
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
    solve(matrix, b, blade.system->pinned(), 1e-4, x[threads - 1]);
  }
  EXPECT_EQ(std::memcmp(x[0].data(), x[1].data(), sizeof(double) * x[0].size()), 0);
}

// Oracle: negative.
TEST(BlockPattern, RefusesAVertexThatIsNotThere) {
  EXPECT_THROW(BlockPattern(2, {(Stencil(1, 2) << 0, 2).finished()}), Error);
}

}  // namespace
}  // namespace wilt
