#include <gtest/gtest.h>

#include <limits>

#include "embedding/distances.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/embedding/embedding.hpp"

namespace wilt {
namespace {

using test::euclidean_distances;
using test::procrustes_error;
using test::scattered;

ErrorCode code_of(const Eigen::MatrixXd& distances) {
  try {
    classical_mds(distances);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return ErrorCode::output;
}

// Oracle: analytic, the points themselves. Round-off of squared distances: 1e-15, times a condition of about
// 1e3 for the narrow sets.
TEST(ClassicalMds, RecoversPlanarPoints) {
  for (const int count : {3, 4, 31, 33, 200, 501}) {
    for (const double width : {1.0, 5.0, 30.0}) {
      const Points2 points = scattered(count, width, 7);
      const Embedding embedding = classical_mds(euclidean_distances(points));
      EXPECT_LT(procrustes_error(embedding.coordinates, points), 1e-11 * width)
          << count << " points, " << width;
      EXPECT_LT(embedding.stress, 1e-22);
    }
  }
}

// Oracle: analytic. A regular polygon has two equal eigenvalues, which one Krylov space cannot tell apart.
TEST(ClassicalMds, RecoversPointsWithEqualEigenvalues) {
  for (const int count : {4, 40, 300}) {
    Points2 points(count, 2);
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      points.row(i) << std::cos(angle), std::sin(angle);
    }
    EXPECT_LT(procrustes_error(classical_mds(euclidean_distances(points)).coordinates, points), 1e-11)
        << count;
  }
}

// Oracle: analytic. The second eigenvalue is zero; its square root keeps half of the digits.
TEST(ClassicalMds, RecoversPointsOnALine) {
  for (const int count : {3, 100}) {
    Points2 points = scattered(count, 2.0, 3);
    points.col(1).setZero();
    EXPECT_LT(procrustes_error(classical_mds(euclidean_distances(points)).coordinates, points), 1e-6)
        << count;
  }
}

TEST(ClassicalMds, PutsCoincidentPointsTogether) {
  for (const int count : {3, 50})
    EXPECT_EQ(classical_mds(Eigen::MatrixXd::Zero(count, count)).coordinates.cwiseAbs().maxCoeff(), 0.0);
}

// Oracle: invariance. A scale of a power of two changes exponents only.
TEST(ClassicalMds, ScalesWithItsDistances) {
  const Eigen::MatrixXd distances = test::spherical_distances(scattered(120, 1.0, 5));
  const Embedding one = classical_mds(distances), tiny = classical_mds(0x1p-20 * distances);
  EXPECT_LT((tiny.coordinates - 0x1p-20 * one.coordinates).cwiseAbs().maxCoeff(), 1e-9 * 0x1p-20);
  EXPECT_NEAR(tiny.stress, one.stress, 1e-9 * one.stress);
}

// Oracle: the same bytes with one thread.
TEST(ClassicalMds, DoesNotDependOnTheNumberOfThreads) {
  const Eigen::MatrixXd distances = test::spherical_distances(scattered(301, 1.0, 5));
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return classical_mds(distances).coordinates;
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(ClassicalMds, RefusesWhatIsNoDistanceMatrix) {
  const Eigen::MatrixXd good = euclidean_distances(scattered(40, 1.0, 1));
  EXPECT_EQ(code_of(good.leftCols(39)), ErrorCode::input);
  EXPECT_EQ(code_of(good.topLeftCorner(2, 2)), ErrorCode::input);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    Eigen::MatrixXd distances = good;
    distances(3, 5) = distances(5, 3) = bad;
    EXPECT_EQ(code_of(distances), ErrorCode::input) << bad;
  }
  Eigen::MatrixXd lopsided = good;
  lopsided(30, 2) *= 1.0 + 1e-6;
  EXPECT_EQ(code_of(lopsided), ErrorCode::input);
}

}  // namespace
}  // namespace wilt
