#include "wilt/simulation/metrics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/self_intersection.hpp"

namespace wilt {
namespace {

constexpr double kWrinkleRadius = 0.1;  // of L
constexpr double kTipRadius = 0.12;     // of L
constexpr int kMostCentres = 4000;
constexpr int kMostNeighbours = 150;

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

// Vertices at least two rings from the boundary.
std::vector<VertexId> deep_interior(const SurfaceMesh& mesh) {
  std::vector<bool> near_boundary(mesh.num_vertices(), false);
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) continue;
    near_boundary[v] = true;
    mesh.for_outgoing(v, [&](HalfedgeId h) { near_boundary[mesh.to(h)] = true; });
  }
  std::vector<VertexId> deep;
  for (const VertexId v : mesh.vertices()) {
    if (!near_boundary[v]) deep.push_back(v);
  }
  return deep;
}

template <class T>
std::vector<T> thinned(const std::vector<T>& all, int most) {
  if (static_cast<int>(all.size()) <= most) return all;
  std::vector<T> some;
  for (int i = 0; i < most; ++i) some.push_back(all[static_cast<std::size_t>(i) * all.size() / most]);
  return some;
}

Vec3 mean_normal(const Points3& normals, VertexId centre, const std::vector<VertexId>& around) {
  Vec3 sum = normals.row(centre).transpose();
  for (const VertexId v : around) sum += normals.row(v).transpose();
  return sum.normalized();
}

// Height of the vertex over the quadric z = c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2 fitted around it, in
// the frame whose z is the vertex normal and whose origin is the vertex: c0.
double height_over_quadric(const Points3& positions, VertexId centre, const std::vector<VertexId>& around,
                           const Vec3& normal, double scale) {
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (const VertexId v : around) {
    const Vec3 r = (positions.row(v) - positions.row(centre)).transpose() / scale;
    const double x = r.dot(u), y = r.dot(w);
    Eigen::Matrix<double, 6, 1> basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    gram += basis * basis.transpose();
    right += r.dot(normal) * basis;
  }
  return scale * gram.ldlt().solve(right)[0];
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
      rest_normals_(vertex_normals(mesh, rest)) {
  std::vector<int> mark(mesh.num_vertices(), -1);
  for (const VertexId v : thinned(deep_interior(mesh), kMostCentres)) {
    Stencil stencil{v,
                    thinned(neighbourhood(mesh, rest, v, kWrinkleRadius * length_, mark), kMostNeighbours)};
    if (stencil.around.size() >= 9) wrinkle_stencils_.push_back(std::move(stencil));
  }
  std::fill(mark.begin(), mark.end(), -1);
  for (const VertexId tip : tips)
    tip_stencils_.push_back({tip, neighbourhood(mesh, rest, tip, kTipRadius * length_, mark)});
  petiole_ring_ = mesh.one_ring(petiole);
  petiole_ring_.push_back(petiole);
}

double LeafMetrics::wrinkle(const Points3& positions) const {
  if (wrinkle_stencils_.empty()) return 0.0;
  const Points3 normals = vertex_normals(mesh_, positions);
  const int count = static_cast<int>(wrinkle_stencils_.size());
  const double sum = parallel_sum(count, 256, [&](int begin, int end) {
    double squares = 0.0;
    for (int i = begin; i < end; ++i) {
      const Stencil& s = wrinkle_stencils_[i];
      const double height = height_over_quadric(positions, s.centre, s.around,
                                                normals.row(s.centre).transpose(), kWrinkleRadius * length_);
      squares += height * height;
    }
    return squares;
  });
  return std::sqrt(sum / count) / length_;
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
  const EdgeData<double> lengths = edge_lengths(mesh_, positions);
  double largest = 0.0;
  for (const EdgeId e : mesh_.edges())
    largest = std::max(largest, std::abs(lengths[e] / rest_lengths_[e] - 1.0));
  return largest;
}

FrameMetrics LeafMetrics::measure(const Points3& positions, int iteration) const {
  FrameMetrics m;
  m.iteration = iteration;
  m.wrinkle = wrinkle(positions);
  m.curl = curl(positions);
  m.area_ratio = surface_area(mesh_, positions) / rest_surface_;
  m.projected_area_ratio = area_vector(mesh_, positions).dot(rest_area_) / rest_area_.squaredNorm();
  m.max_strain = max_strain(positions);
  m.self_intersections = count_self_intersections(mesh_.face_matrix(), positions);
  return m;
}

}  // namespace wilt
