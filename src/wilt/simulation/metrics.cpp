#include "wilt/simulation/metrics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/self_intersection.hpp"

namespace wilt {
namespace {

constexpr double kTipRadius = 0.12;  // of L
constexpr int kBlock = 4096;         // elements that are summed up by one thread

double petiole_to_farthest(const Points3& rest, VertexId petiole) {
  return std::sqrt((rest.rowwise() - rest.row(petiole)).rowwise().squaredNorm().maxCoeff());
}

// The vertices connected to `centre` through vertices within `radius` of it at rest, without it.
std::vector<VertexId> neighbourhood(const SurfaceMesh& mesh, const Points3& rest, VertexId centre,
                                    double radius, std::vector<int>& mark) {
  std::vector<VertexId> found{centre};
  mark[centre] = centre;
  for (std::size_t i = 0; i < found.size(); ++i) {
    mesh.for_outgoing(found[i], [&](HalfedgeId h) {
      const VertexId v = mesh.to(h);
      if (mark[v] == centre || (rest.row(v) - rest.row(centre)).norm() > radius) return;
      mark[v] = centre;
      found.push_back(v);
    });
  }
  found.erase(found.begin());
  return found;
}

Vec3 mean_normal(const Points3& normals, VertexId centre, const std::vector<VertexId>& around) {
  Vec3 sum = normals.row(centre).transpose();
  for (const VertexId v : around) sum += normals.row(v).transpose();
  return sum.normalized();
}

struct Areas {
  double surface = 0.0;
  Vec3 vector = Vec3::Zero();
};

Areas areas_of(const Faces& faces, const Points3& positions) {
  const int count = static_cast<int>(faces.rows());
  std::vector<Areas> blocks(static_cast<std::size_t>((count + kBlock - 1) / kBlock));
  parallel_for(static_cast<int>(blocks.size()), 1, [&](int begin, int end) {
    for (int block = begin; block < end; ++block) {
      Areas& sum = blocks[static_cast<std::size_t>(block)];
      for (int f = block * kBlock; f < std::min(count, (block + 1) * kBlock); ++f) {
        const Vec3 ab = (positions.row(faces(f, 1)) - positions.row(faces(f, 0))).transpose(),
                   ac = (positions.row(faces(f, 2)) - positions.row(faces(f, 0))).transpose();
        const Vec3 vector = 0.5 * ab.cross(ac);
        sum.surface += vector.norm();
        sum.vector += vector;
      }
    }
  });
  Areas total;
  for (const Areas& sum : blocks) total.surface += sum.surface, total.vector += sum.vector;
  return total;
}

}  // namespace

Eigen::Matrix3d best_rotation(const Points3& rest, const Points3& current,
                              const std::vector<VertexId>& vertices) {
  Vec3 rest_mean = Vec3::Zero(), current_mean = Vec3::Zero();
  for (const VertexId v : vertices) {
    rest_mean += rest.row(v).transpose();
    current_mean += current.row(v).transpose();
  }
  rest_mean /= static_cast<double>(vertices.size());
  current_mean /= static_cast<double>(vertices.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const VertexId v : vertices)
    covariance +=
        (current.row(v).transpose() - current_mean) * (rest.row(v).transpose() - rest_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1.0, 1.0, 1.0);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs[2] = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

LeafMetrics::LeafMetrics(const SurfaceMesh& mesh, const Points3& rest, VertexId petiole,
                         const std::vector<VertexId>& tips)
    : mesh_(mesh),
      rest_(rest),
      length_(petiole_to_farthest(rest, petiole)),
      rest_area_(area_vector(mesh, rest)),
      rest_surface_(surface_area(mesh, rest)),
      rest_lengths_(edge_lengths(mesh, rest)),
      rest_normals_(vertex_normals(mesh, rest)),
      wrinkle_(mesh, rest, length_) {
  std::vector<int> mark(mesh.num_vertices(), -1);
  for (const VertexId tip : tips)
    tip_stencils_.push_back({tip, neighbourhood(mesh, rest, tip, kTipRadius * length_, mark)});
  petiole_ring_ = mesh.one_ring(petiole);
  petiole_ring_.push_back(petiole);
}

double LeafMetrics::curl(const Points3& positions) const {
  if (tip_stencils_.empty()) return 0.0;
  const Points3 normals = vertex_normals(mesh_, positions);
  const Eigen::Matrix3d petiole_turn = best_rotation(rest_, positions, petiole_ring_);
  double sum = 0.0;
  for (const Stencil& s : tip_stencils_) {
    const Vec3 expected = petiole_turn * mean_normal(rest_normals_, s.centre, s.around);
    const Vec3 now = mean_normal(normals, s.centre, s.around);
    sum += std::atan2(expected.cross(now).norm(), expected.dot(now));
  }
  return sum / static_cast<double>(tip_stencils_.size());
}

double LeafMetrics::max_strain(const Points3& positions) const {
  const int count = mesh_.num_edges();
  std::vector<double> largest(static_cast<std::size_t>((count + kBlock - 1) / kBlock), 0.0);
  parallel_for(static_cast<int>(largest.size()), 1, [&](int begin, int end) {
    for (int block = begin; block < end; ++block) {
      double& most = largest[static_cast<std::size_t>(block)];
      for (EdgeId e(block * kBlock); e < std::min(count, (block + 1) * kBlock); e = EdgeId(e + 1)) {
        const auto [a, b] = mesh_.edge_vertices(e);
        const double length = (positions.row(b) - positions.row(a)).norm();
        most = std::max(most, std::abs(length / rest_lengths_[e] - 1.0));
      }
    }
  });
  return *std::max_element(largest.begin(), largest.end());
}

FrameMetrics LeafMetrics::measure(const Points3& positions, int iteration) const {
  FrameMetrics m;
  m.iteration = iteration;
  m.wrinkle = wrinkle(positions);
  m.curl = curl(positions);
  const Areas areas = areas_of(mesh_.face_matrix(), positions);
  m.area_ratio = areas.surface / rest_surface_;
  m.projected_area_ratio = areas.vector.dot(rest_area_) / rest_area_.squaredNorm();
  m.max_strain = max_strain(positions);
  m.self_intersections = count_self_intersections(mesh_.face_matrix(), positions);
  return m;
}

}  // namespace wilt
