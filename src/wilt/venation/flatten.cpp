#include "wilt/venation/flatten.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "wilt/embedding/embedding.hpp"

namespace wilt::detail {
namespace {

constexpr double kRelaxation = 1.8;  // of SMACOF

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Vertices far from each other in space: the petiole, then each time the farthest from those chosen.
std::vector<VertexId> spread_landmarks(const Points3& positions, VertexId first, int count) {
  std::vector<VertexId> landmarks{first};
  Eigen::VectorXd nearest = (positions.rowwise() - positions.row(first)).rowwise().squaredNorm();
  while (static_cast<int>(landmarks.size()) < count) {
    // Of those as far, to round-off, the first: a moved leaf has the same landmarks.
    const double enough = (1.0 - 1e-9) * nearest.maxCoeff();
    int farthest = 0;
    while (nearest(farthest) < enough) ++farthest;
    landmarks.push_back(VertexId(farthest));
    nearest = nearest.cwiseMin((positions.rowwise() - positions.row(farthest)).rowwise().squaredNorm());
  }
  return landmarks;
}

/// Turns (and mirrors) the plane so that two embeddings of one leaf can be laid over each other.
Points2 oriented(const Points2& points, const SurfaceMesh& mesh, VertexId petiole) {
  Points2 result = points.rowwise() - points.row(petiole);
  double area = 0.0;
  for (const FaceId f : mesh.faces()) {
    const auto [a, b, c] = mesh.face_vertices(f);
    const Vec2 ab = (result.row(b) - result.row(a)).transpose(),
               ac = (result.row(c) - result.row(a)).transpose();
    area += ab.x() * ac.y() - ab.y() * ac.x();
  }
  if (area < 0.0) result.col(0) *= -1.0;
  const Vec2 centroid = result.colwise().mean().transpose();
  const Vec2 up = centroid.norm() > 0.0 ? Vec2(centroid.normalized()) : Vec2(Vec2::UnitY());
  Eigen::Matrix2d turn;
  turn << up.y(), -up.x(), up.x(), up.y();
  return result * turn.transpose();
}

}  // namespace

Flattened flatten(const Leaf& leaf, const FastGeodesics& fast, const VenationOptions& options,
                  const Monitor& monitor) {
  const int vertices = leaf.mesh.num_vertices();
  const std::vector<VertexId> landmarks =
      spread_landmarks(leaf.positions, leaf.petiole, std::min(options.landmarks, vertices));
  const std::vector<int> columns(landmarks.begin(), landmarks.end());
  Clock::time_point distances_known;
  Embedding embedding;
  if (vertices <= options.full_embedding_up_to) {
    const Eigen::MatrixXd distances = all_pairs(leaf.mesh, leaf.positions, options.geodesics, monitor);
    distances_known = Clock::now();
    const Points2 start = landmark_mds(distances(Eigen::all, columns), columns).coordinates;
    embedding = smacof(distances, start, {.relaxation = kRelaxation}, monitor);
  } else {
    const Eigen::MatrixXd distances =
        options.geodesics == GeodesicMethod::fast
            ? fast.distances(landmarks, monitor)
            : geodesic_distances(leaf.mesh, leaf.positions, landmarks, GeodesicMethod::exact, monitor);
    distances_known = Clock::now();
    embedding = landmark_mds(distances, columns, {}, monitor);
  }
  Flattened result;
  result.coordinates = oriented(embedding.coordinates, leaf.mesh, leaf.petiole);
  result.stress = embedding.stress;
  result.embedding_seconds = seconds(distances_known, Clock::now());
  return result;
}

}  // namespace wilt::detail
