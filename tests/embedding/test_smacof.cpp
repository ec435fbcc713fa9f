#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

#include "embedding/distances.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/embedding/embedding.hpp"

namespace wilt {
namespace {

using test::euclidean_distances;
using test::procrustes_error;
using test::scattered;
using test::spherical_distances;

// Stops only when the stress no longer falls.
constexpr SmacofOptions kLong{2000, 1e-300};

double stress_by_definition(const Eigen::MatrixXd& distances, const Points2& points) {
  double raw = 0.0, scale = 0.0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double error = (points.row(i) - points.row(j)).norm() - distances(i, j);
      raw += error * error;
      scale += distances(i, j) * distances(i, j);
    }
  }
  return raw / scale;
}

// Oracle: analytic. Distances of points in the plane are met exactly, but for round-off, once nothing
// improves.
TEST(Smacof, RecoversPlanarPointsFromADisturbedStart) {
  const Points2 points = scattered(150, 2.0, 2);
  Points2 start = points + 0.05 * scattered(150, 1.0, 9);
  const Embedding embedding = smacof(euclidean_distances(points), start, kLong);
  EXPECT_LT(embedding.stress, 1e-24);
  EXPECT_LT(procrustes_error(embedding.coordinates, points), 1e-10);
}

// Oracle: the definition in the header, term by term.
TEST(Smacof, ReportsTheStressOfWhatItReturns) {
  for (const int count : {4, 50, 101}) {
    const Points2 angles = scattered(count, 1.5, 4);
    const Eigen::MatrixXd distances = spherical_distances(angles);
    const Embedding classical = classical_mds(distances);
    EXPECT_NEAR(classical.stress, stress_by_definition(distances, classical.coordinates), 1e-12);
    const Embedding embedding = smacof(distances, classical.coordinates);
    EXPECT_NEAR(embedding.stress, stress_by_definition(distances, embedding.coordinates), 1e-12);
    ASSERT_FALSE(embedding.history.empty());
    EXPECT_EQ(embedding.stress, embedding.history.back());
  }
}

// Oracle: property, the majorisation theorem. From random starts, to round-off.
TEST(Smacof, NeverRaisesTheStress) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::MatrixXd distances = spherical_distances(scattered(60, 3.0, seed));
    const Points2 start = scattered(60, 1.0, seed + 100);
    const Embedding embedding = smacof(distances, start, kLong);
    double before = stress_by_definition(distances, start);
    for (const double stress : embedding.history) {
      EXPECT_LT(stress, before) << "seed " << seed;
      before = stress;
    }
    EXPECT_GT(embedding.history.size(), 5u) << "seed " << seed;
  }
}

// Differential: relaxed steps lead to the same minimum, and come within 1e-4 of it sooner.
TEST(Smacof, RelaxedComesToTheSameOptimumSooner) {
  const Eigen::MatrixXd distances = spherical_distances(scattered(200, 1.5, 6));
  const Points2 start = classical_mds(distances).coordinates;
  const Embedding plain = smacof(distances, start, {5000, 1e-12});
  const Embedding relaxed = smacof(distances, start, {5000, 1e-12, 1.8});
  EXPECT_NEAR(relaxed.stress, plain.stress, 1e-9 * plain.stress);
  EXPECT_LT(procrustes_error(relaxed.coordinates, plain.coordinates), 1e-4);
  const auto iterations = [&](const Embedding& embedding) {
    return std::count_if(embedding.history.begin(), embedding.history.end(),
                         [&](double stress) { return stress > (1.0 + 1e-4) * plain.stress; });
  };
  std::printf("within 1e-4: %td iterations, relaxed %td\n", iterations(plain), iterations(relaxed));
  EXPECT_LT(iterations(relaxed), iterations(plain));
}

// Oracle: finite differences. At a minimum the derivative of the stress vanishes.
TEST(Smacof, EndsWhereTheGradientVanishes) {
  const Eigen::MatrixXd distances = spherical_distances(scattered(40, 1.5, 6));
  const Embedding embedding = smacof(distances, classical_mds(distances).coordinates, {20000, 1e-15});
  for (const int i : {0, 17, 39}) {
    for (const int axis : {0, 1}) {
      Points2 right = embedding.coordinates, left = embedding.coordinates;
      right(i, axis) += 1e-4;
      left(i, axis) -= 1e-4;
      const double slope =
          (stress_by_definition(distances, right) - stress_by_definition(distances, left)) / 2e-4;
      // The stress is about 0.01 and its second derivative about 1: a slope of 1e-6 is a distance of 1e-6.
      EXPECT_NEAR(slope, 0.0, 1e-6);
    }
  }
}

// Oracle: invariance. Relabelling changes only the order of sums.
TEST(Smacof, DoesNotDependOnLabelsNorScale) {
  const int count = 90;
  const Eigen::MatrixXd distances = spherical_distances(scattered(count, 1.5, 8));
  Eigen::PermutationMatrix<Eigen::Dynamic> shuffle(count);
  shuffle.setIdentity();
  Random random(8, "labels");
  for (int i = count - 1; i > 0; --i) std::swap(shuffle.indices()(i), shuffle.indices()(random.index(i + 1)));
  const Eigen::MatrixXd relabelled = shuffle * (1000.0 * distances) * shuffle.transpose();

  const Embedding one = smacof(distances, classical_mds(distances).coordinates);
  const Embedding other = smacof(relabelled, classical_mds(relabelled).coordinates);
  const Points2 back = 1e-3 * (shuffle.transpose() * other.coordinates);
  EXPECT_EQ(one.history.size(), other.history.size());
  EXPECT_NEAR(one.stress, other.stress, 1e-9 * one.stress);
  EXPECT_LT(procrustes_error(back, one.coordinates), 1e-9);
}

// Oracle: the same bytes with one thread.
TEST(Smacof, DoesNotDependOnTheNumberOfThreads) {
  const Eigen::MatrixXd distances = spherical_distances(scattered(303, 1.5, 5));
  const Points2 start = scattered(303, 1.0, 1);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return smacof(distances, start);
  };
  const Embedding one = with(1), two = with(2);
  EXPECT_EQ(one.coordinates, two.coordinates);
  EXPECT_EQ(one.history, two.history);
}

// Points at one place have no direction to be pushed in; they stay together and nothing becomes NaN.
TEST(Smacof, EnduresCoincidentPoints) {
  const Points2 points = scattered(30, 1.0, 1);
  Points2 start = points;
  start.row(3) = start.row(7);
  const Embedding embedding = smacof(euclidean_distances(points), start, {50, 1e-9});
  ASSERT_TRUE(embedding.coordinates.allFinite());
  EXPECT_LT((embedding.coordinates.row(3) - embedding.coordinates.row(7)).norm(), 1.0);
  EXPECT_EQ(smacof(Eigen::MatrixXd::Zero(5, 5), Points2::Zero(5, 2)).stress, 0.0);
}

TEST(Smacof, StopsWhenTheUserAsks) {
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  const Points2 points = scattered(10, 1.0, 1);
  EXPECT_THROW(smacof(euclidean_distances(points), points, {}, monitor), Error);
}

TEST(Smacof, RefusesWrongStartsAndOptions) {
  const Points2 points = scattered(10, 1.0, 1);
  const Eigen::MatrixXd distances = euclidean_distances(points);
  Points2 broken = points;
  broken(4, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(smacof(distances, points.topRows(9)), Error);
  EXPECT_THROW(smacof(distances, broken), Error);
  EXPECT_THROW(smacof(distances, points, {0, 1e-5}), Error);
  EXPECT_THROW(smacof(distances, points, {10, 0.0}), Error);
  EXPECT_THROW(smacof(distances, points, {10, 1e-5, 2.0}), Error);
  EXPECT_THROW(smacof(distances, points, {10, 1e-5, 0.9}), Error);
  EXPECT_THROW(smacof(distances, points, {10, std::numeric_limits<double>::quiet_NaN()}), Error);
}

}  // namespace
}  // namespace wilt
