#include "wilt/mesh/geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

Vec3 face_cross(const SurfaceMesh& mesh, const Points3& positions, FaceId f) {
  const auto [a, b, c] = mesh.face_vertices(f);
  const Vec3 ab = positions.row(b) - positions.row(a);
  const Vec3 ac = positions.row(c) - positions.row(a);
  return ab.cross(ac);
}

}  // namespace

EdgeData<double> edge_lengths(const SurfaceMesh& mesh, const Points3& positions) {
  EdgeData<double> lengths(mesh.num_edges());
  for (const EdgeId e : mesh.edges()) {
    const auto [a, b] = mesh.edge_vertices(e);
    lengths[e] = (positions.row(b) - positions.row(a)).norm();
  }
  return lengths;
}

double mean_edge_length(const SurfaceMesh& mesh, const Points3& positions) {
  const EdgeData<double> lengths = edge_lengths(mesh, positions);
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / lengths.size();
}

FaceData<double> face_areas(const SurfaceMesh& mesh, const Points3& positions) {
  FaceData<double> areas(mesh.num_faces());
  parallel_for(mesh.num_faces(), 4096, [&](int begin, int end) {
    for (FaceId f(begin); f < end; f = FaceId(f + 1)) areas[f] = 0.5 * face_cross(mesh, positions, f).norm();
  });
  return areas;
}

double surface_area(const SurfaceMesh& mesh, const Points3& positions) {
  const FaceData<double> areas = face_areas(mesh, positions);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

VertexData<double> vertex_areas(const SurfaceMesh& mesh, const Points3& positions) {
  const FaceData<double> areas = face_areas(mesh, positions);
  VertexData<double> result(mesh.num_vertices(), 0.0);
  for (const FaceId f : mesh.faces()) {
    for (const VertexId v : mesh.face_vertices(f)) result[v] += areas[f] / 3.0;
  }
  return result;
}

Points3 vertex_normals(const SurfaceMesh& mesh, const Points3& positions) {
  Points3 normals = Points3::Zero(mesh.num_vertices(), 3);
  for (const FaceId f : mesh.faces()) {
    const Vec3 cross = face_cross(mesh, positions, f);
    for (const VertexId v : mesh.face_vertices(f)) normals.row(v) += cross;
  }
  for (const VertexId v : mesh.vertices()) {
    const double length = normals.row(v).norm();
    if (length > 0.0) {
      normals.row(v) /= length;
    } else {
      normals.row(v) << 0.0, 0.0, 1.0;
    }
  }
  return normals;
}

Vec3 area_vector(const Faces& faces, const Points3& positions) {
  Vec3 sum = Vec3::Zero();
  for (int f = 0; f < faces.rows(); ++f) {
    const Vec3 ab = positions.row(faces(f, 1)) - positions.row(faces(f, 0));
    const Vec3 ac = positions.row(faces(f, 2)) - positions.row(faces(f, 0));
    sum += 0.5 * ab.cross(ac);
  }
  return sum;
}

Vec3 area_vector(const SurfaceMesh& mesh, const Points3& positions) {
  return area_vector(mesh.face_matrix(), positions);
}

double smallest_angle(const SurfaceMesh& mesh, const Points3& positions) {
  double smallest = std::numbers::pi;
  for (const FaceId f : mesh.faces()) {
    const auto corners = mesh.face_vertices(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = positions.row(corners[(k + 1) % 3]) - positions.row(corners[k]);
      const Vec3 w = positions.row(corners[(k + 2) % 3]) - positions.row(corners[k]);
      smallest = std::min(smallest, std::atan2(u.cross(w).norm(), u.dot(w)));
    }
  }
  return smallest;
}

double dihedral_angle(const SurfaceMesh& mesh, const Points3& positions, EdgeId edge) {
  if (mesh.is_boundary(edge)) return 0.0;
  const HalfedgeId h = mesh.halfedge(edge);
  const Vec3 along = (positions.row(mesh.to(h)) - positions.row(mesh.from(h))).normalized();
  const Vec3 n0 = face_cross(mesh, positions, mesh.face(h));
  const Vec3 n1 = face_cross(mesh, positions, mesh.face(mesh.twin(h)));
  return std::atan2(along.dot(n0.cross(n1)), n0.dot(n1));
}

double loop_length(const Points3& positions, const std::vector<VertexId>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (positions.row(loop[(i + 1) % loop.size()]) - positions.row(loop[i])).norm();
  return length;
}

const std::vector<VertexId>& margin_loop(const SurfaceMesh& mesh, const Points3& positions) {
  const auto& loops = mesh.boundary_loops();
  if (loops.empty())
    throw Error(ErrorCode::input, "the surface is closed; a leaf needs a margin, so cut it open along one");
  return *std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
    return loop_length(positions, a) < loop_length(positions, b);
  });
}

}  // namespace wilt
