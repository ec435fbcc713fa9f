#include "wilt/venation/flatten.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "wilt/embedding/embedding.hpp"

namespace wilt::detail {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Vertices far from each other in space: the petiole, then each time the farthest from those chosen.
std::vector<VertexId> spread_landmarks(const Points3& positions, VertexId first, int count) {
  std::vector<VertexId> landmarks{first};
  Eigen::VectorXd nearest = (positions.rowwise() - positions.row(first)).rowwise().squaredNorm();
  while (static_cast<int>(landmarks.size()) < count) {
    int farthest = 0;
    nearest.maxCoeff(&farthest);
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

Flattened flatten(const Leaf& leaf, const VenationOptions& options, const Monitor& monitor) {
  const int vertices = leaf.mesh.num_vertices();
  const auto begin = Clock::now();
  auto distances_known = begin;
  Embedding embedding;
  if (vertices <= options.full_embedding_up_to) {
    const Eigen::MatrixXd distances = all_pairs(leaf.mesh, leaf.positions, options.geodesics, monitor);
    distances_known = Clock::now();
    embedding = smacof(distances, classical_mds(distances).coordinates, {}, monitor);
  } else {
    const std::vector<VertexId> landmarks =
        spread_landmarks(leaf.positions, leaf.petiole, std::min(options.landmarks, vertices));
    const Eigen::MatrixXd distances =
        geodesic_distances(leaf.mesh, leaf.positions, landmarks, options.geodesics, monitor);
    distances_known = Clock::now();
    embedding = landmark_mds(distances, {landmarks.begin(), landmarks.end()}, {}, monitor);
  }
  Flattened result;
  result.coordinates = oriented(embedding.coordinates, leaf.mesh, leaf.petiole);
  result.stress = embedding.stress;
  result.geodesics_seconds = seconds(begin, distances_known);
  result.embedding_seconds = seconds(distances_known, Clock::now());
  return result;
}

}  // namespace wilt::detail
