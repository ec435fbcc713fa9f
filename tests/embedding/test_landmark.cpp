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

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& distances, const std::vector<int>& landmarks) {
  Eigen::MatrixXd columns(distances.rows(), landmarks.size());
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    columns.col(static_cast<Eigen::Index>(a)) = distances.col(landmarks[a]);
  return columns;
}

std::vector<int> every(int step, int count) {
  std::vector<int> landmarks;
  for (int i = 0; i < count; i += step) landmarks.push_back(i);
  return landmarks;
}

// Oracle: analytic, the points themselves. The descent stops at 1e-6 of the extent.
TEST(LandmarkMds, RecoversPlanarPoints) {
  const Points2 points = scattered(400, 3.0, 2);
  const std::vector<int> landmarks = every(20, 400);
  const Embedding embedding = landmark_mds(columns_of(euclidean_distances(points), landmarks), landmarks);
  EXPECT_LT(procrustes_error(embedding.coordinates, points), 1e-5);
}

// Oracle: differential against SMACOF on all pairs. A cap of a sphere of 0.4 radians cannot be flattened; the
// two minimise over different pairs: a percent of the extent is a band that half the landmarks also meet.
TEST(LandmarkMds, ComesNearTheFullEmbedding) {
  const Points2 angles = 0.4 * scattered(500, 1.5, 3);
  const Eigen::MatrixXd distances = test::spherical_distances(angles);
  const std::vector<int> landmarks = every(9, 500);
  const Embedding full = smacof(distances, classical_mds(distances).coordinates);
  const Embedding few = landmark_mds(columns_of(distances, landmarks), landmarks);
  EXPECT_LT(procrustes_error(few.coordinates, full.coordinates), 0.01 * distances.maxCoeff());
  EXPECT_LT(few.stress, 2.0 * full.stress);
  EXPECT_GT(few.stress, 0.5 * full.stress);
}

// Oracle: finite differences of a vertex's own stress to the landmarks, which is least at its place.
TEST(LandmarkMds, PutsEachVertexWhereItsStressIsLeast) {
  const Eigen::MatrixXd distances = test::spherical_distances(scattered(200, 1.5, 3));
  const std::vector<int> landmarks = every(10, 200);
  const Points2 points = landmark_mds(columns_of(distances, landmarks), landmarks).coordinates;
  const auto stress = [&](int v, const Vec2& x) {
    double sum = 0.0;
    for (const int a : landmarks) {
      const double error = (x - points.row(a).transpose()).norm() - distances(a, v);
      sum += error * error;
    }
    return sum / static_cast<double>(landmarks.size());
  };
  for (const int v : {1, 55, 199}) {
    const Vec2 x = points.row(v).transpose();
    for (const Vec2& step : {Vec2(1e-4, 0.0), Vec2(0.0, 1e-4)})
      EXPECT_NEAR((stress(v, x + step) - stress(v, x - step)) / 2e-4, 0.0, 1e-5) << v;
  }
}

// Oracle: the same bytes with one thread.
TEST(LandmarkMds, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<int> landmarks = every(13, 400);
  const Eigen::MatrixXd distances = columns_of(test::spherical_distances(scattered(400, 1.0, 2)), landmarks);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return landmark_mds(distances, landmarks).coordinates;
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(LandmarkMds, RefusesWrongLandmarks) {
  const Eigen::MatrixXd distances = euclidean_distances(scattered(20, 1.0, 2));
  EXPECT_THROW(landmark_mds(distances.leftCols(2), {0, 1}), Error);
  EXPECT_THROW(landmark_mds(distances.leftCols(4), {0, 1, 2}), Error);
  EXPECT_THROW(landmark_mds(distances.leftCols(3), {0, 1, 20}), Error);
  EXPECT_THROW(landmark_mds(distances.leftCols(3), {0, 1, -1}), Error);
  Eigen::MatrixXd broken = distances.leftCols(3);
  broken(9, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(landmark_mds(broken, {0, 1, 2}), Error);
}

}  // namespace
}  // namespace wilt
