// Landmark scaling (de Silva and Tenenbaum 2004).
//
//   L     #L x 2   the landmarks in the plane, by SMACOF, centred
//   D_va  #V x #L  distances from landmark a to vertex v
//   x_v   starts where the linear least squares of |x - L_a|^2 = D_va^2 puts it (the paper's triangulation)
//   and
//         then descends sum_a (|x_v - L_a| - D_va)^2, a SMACOF of one point:
//         x+ = 1/#L sum_a (L_a + D_va (x - L_a) / |x - L_a|)
#include <fmt/format.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/parallel.hpp"
#include "wilt/core/simd.hpp"
#include "wilt/embedding/distances.hpp"

namespace wilt {
namespace {

constexpr int kMaxSteps = 100;       // of one vertex's descent
constexpr double kSmallMove = 1e-6;  // a step to stop at, in units of the landmarks' extent

void validate(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks) {
  const int count = static_cast<int>(landmarks.size());
  if (count < 3 || landmark_distances.cols() != count)
    throw Error(
        ErrorCode::input,
        fmt::format("landmark_mds: {} landmarks and {} columns of distances; it takes 3 or more landmarks "
                    "and a column for each",
                    count, landmark_distances.cols()));
  for (const int landmark : landmarks) {
    if (landmark >= 0 && landmark < landmark_distances.rows()) continue;
    throw Error(ErrorCode::input, fmt::format("landmark_mds: landmark {} is not a row of distances (0 to {})",
                                              landmark, landmark_distances.rows() - 1));
  }
  detail::validate_entries(landmark_distances);
}

/// The landmarks in the plane; their mutual distances averaged over both directions.
Embedding embed_landmarks(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks,
                          const SmacofOptions& options, const Monitor& monitor) {
  const int count = static_cast<int>(landmarks.size());
  Eigen::MatrixXd mutual(count, count);
  for (int j = 0; j < count; ++j) mutual.row(j) = landmark_distances.row(landmarks[j]);
  const Eigen::MatrixXd symmetric = 0.5 * (mutual + mutual.transpose());
  Embedding embedding = smacof(symmetric, classical_mds(symmetric).coordinates, options, monitor);
  embedding.coordinates.rowwise() -= embedding.coordinates.colwise().mean().eval();
  return embedding;
}

/// The landmarks, coordinate by coordinate, padded with zeros to whole vectors.
struct Anchors {
  explicit Anchors(const Points2& points) : count(static_cast<int>(points.rows())) {
    const int padded = (count + simd::kLanes - 1) / simd::kLanes * simd::kLanes;
    for (int axis = 0; axis < 2; ++axis) {
      (axis == 0 ? x : y).assign(padded, 0.0);
      for (int a = 0; a < count; ++a) (axis == 0 ? x : y)[a] = points(a, axis);
    }
  }

  int count;
  std::vector<double> x, y;
};

/// x+ of a vertex at `x` with its distances, padded as the anchors are.
WILT_CLONES Vec2 majorise(const Vec2& x, const Anchors& anchors, const double* distances) {
  Double8 sum_x{}, sum_y{};
  for (std::size_t a = 0; a < anchors.x.size(); a += simd::kLanes) {
    const Double8 anchor_x = simd::load(&anchors.x[a]), anchor_y = simd::load(&anchors.y[a]);
    const Double8 away_x = x.x() - anchor_x, away_y = x.y() - anchor_y;
    const Double8 ratio =
        simd::load(distances + a) / simd::sqrt(away_x * away_x + away_y * away_y + simd::kTiny);
    sum_x += anchor_x + ratio * away_x;
    sum_y += anchor_y + ratio * away_y;
  }
  return Vec2(simd::sum(sum_x), simd::sum(sum_y)) / anchors.count;
}

Vec2 descend(Vec2 x, const Anchors& anchors, const double* distances, double small_move) {
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec2 next = majorise(x, anchors, distances);
    const double move = (next - x).norm();
    x = next;
    if (move <= small_move) break;
  }
  return x;
}

double stress_over_pairs(const Eigen::MatrixXd& landmark_distances, const Points2& landmarks,
                         const Points2& points) {
  const double raw = parallel_sum(static_cast<int>(points.rows()), 64, [&](int begin, int end) {
    double sum = 0.0;
    for (int v = begin; v < end; ++v)
      sum += ((landmarks.rowwise() - points.row(v)).rowwise().norm() - landmark_distances.row(v).transpose())
                 .squaredNorm();
    return sum;
  });
  const double scale = landmark_distances.squaredNorm();
  return scale > 0.0 ? raw / scale : 0.0;
}

}  // namespace

Embedding landmark_mds(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks,
                       const SmacofOptions& options, const Monitor& monitor) {
  validate(landmark_distances, landmarks);
  Embedding result = embed_landmarks(landmark_distances, landmarks, options, monitor);
  const Points2 landmark_points = result.coordinates;
  const Anchors anchors(landmark_points);
  const Eigen::VectorXd squared_radius = landmark_points.rowwise().squaredNorm();
  const Eigen::Matrix2Xd pseudo_inverse =
      Eigen::MatrixXd(landmark_points).completeOrthogonalDecomposition().pseudoInverse();
  const double small_move = kSmallMove * std::sqrt(squared_radius.maxCoeff());

  result.coordinates.resize(landmark_distances.rows(), 2);
  parallel_for(static_cast<int>(landmark_distances.rows()), 64, [&](int begin, int end) {
    Eigen::VectorXd distances = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(anchors.x.size()));
    for (int v = begin; v < end; ++v) {
      distances.head(anchors.count) = landmark_distances.row(v).transpose();
      const Eigen::VectorXd power = squared_radius - distances.head(anchors.count).cwiseAbs2();
      const Vec2 start = 0.5 * (pseudo_inverse * power);
      result.coordinates.row(v) = descend(start, anchors, distances.data(), small_move).transpose();
    }
  });
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    result.coordinates.row(landmarks[a]) = landmark_points.row(static_cast<Eigen::Index>(a));
  result.stress = stress_over_pairs(landmark_distances, landmark_points, result.coordinates);
  return result;
}

}  // namespace wilt
