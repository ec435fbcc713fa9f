// Landmark scaling (de Silva and Tenenbaum 2004).
//
//   L     #L x 2   the landmarks in the plane, by SMACOF, centred
//   D_av  #L x #V  distances from landmark a to vertex v
//   x_v   starts where the linear least squares of |x - L_a|^2 = D_av^2 puts it (the paper's triangulation)
//   and
//         then descends sum_a (|x_v - L_a| - D_av)^2, a SMACOF of one point:
//         x+ = 1/#L sum_a (L_a + D_av (x - L_a) / |x - L_a|)
#include <fmt/format.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/parallel.hpp"
#include "wilt/embedding/distances.hpp"

namespace wilt {
namespace {

constexpr int kMaxSteps = 100;       // of one vertex's descent
constexpr double kSmallMove = 1e-6;  // a step to stop at, in units of the landmarks' extent

void validate(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks) {
  const int count = static_cast<int>(landmarks.size());
  if (count < 3 || landmark_distances.rows() != count)
    throw Error(
        ErrorCode::input,
        fmt::format("landmark_mds: {} landmarks and {} rows of distances; it takes 3 or more landmarks and a "
                    "row for each",
                    count, landmark_distances.rows()));
  for (const int landmark : landmarks) {
    if (landmark >= 0 && landmark < landmark_distances.cols()) continue;
    throw Error(ErrorCode::input,
                fmt::format("landmark_mds: landmark {} is not a column of distances (0 to {})", landmark,
                            landmark_distances.cols() - 1));
  }
  detail::validate_entries(landmark_distances);
}

/// The landmarks in the plane; their mutual distances averaged over both directions.
Embedding embed_landmarks(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks,
                          const SmacofOptions& options, const Monitor& monitor) {
  const int count = static_cast<int>(landmarks.size());
  Eigen::MatrixXd mutual(count, count);
  for (int j = 0; j < count; ++j) mutual.col(j) = landmark_distances.col(landmarks[j]);
  const Eigen::MatrixXd symmetric = 0.5 * (mutual + mutual.transpose());
  Embedding embedding = smacof(symmetric, classical_mds(symmetric).coordinates, options, monitor);
  embedding.coordinates.rowwise() -= embedding.coordinates.colwise().mean().eval();
  return embedding;
}

Vec2 descend(Vec2 x, const Points2& landmarks, const Eigen::VectorXd& distances, double small_move) {
  for (int step = 0; step < kMaxSteps; ++step) {
    Vec2 sum = Vec2::Zero();
    for (Eigen::Index a = 0; a < landmarks.rows(); ++a) {
      const Vec2 landmark = landmarks.row(a).transpose();
      const Vec2 away = x - landmark;
      const double d = away.norm();
      sum += d > 0.0 ? Vec2(landmark + distances(a) / d * away) : x;
    }
    const Vec2 next = sum / static_cast<double>(landmarks.rows());
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
      sum +=
          ((landmarks.rowwise() - points.row(v)).rowwise().norm() - landmark_distances.col(v)).squaredNorm();
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
  const Points2 anchors = result.coordinates;
  const Eigen::VectorXd squared_radius = anchors.rowwise().squaredNorm();
  const Eigen::Matrix2Xd pseudo_inverse =
      Eigen::MatrixXd(anchors).completeOrthogonalDecomposition().pseudoInverse();
  const double small_move = kSmallMove * std::sqrt(squared_radius.maxCoeff());

  result.coordinates.resize(landmark_distances.cols(), 2);
  parallel_for(static_cast<int>(landmark_distances.cols()), 64, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      const Eigen::VectorXd distances = landmark_distances.col(v);
      const Eigen::VectorXd power = squared_radius - distances.cwiseAbs2();
      const Vec2 start = 0.5 * (pseudo_inverse * power);
      result.coordinates.row(v) = descend(start, anchors, distances, small_move).transpose();
    }
  });
  for (std::size_t a = 0; a < landmarks.size(); ++a)
    result.coordinates.row(landmarks[a]) = anchors.row(static_cast<Eigen::Index>(a));
  result.stress = stress_over_pairs(landmark_distances, anchors, result.coordinates);
  return result;
}

}  // namespace wilt
