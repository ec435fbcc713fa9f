#include "wilt/geodesics/surface_path.hpp"

#include <algorithm>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

// Where vertex v stands in face f, or -1.
int corner_of(const SurfaceMesh& mesh, FaceId f, VertexId v) {
  const auto corners = mesh.face_vertices(f);
  const auto found = std::find(corners.begin(), corners.end(), v);
  return found == corners.end() ? -1 : static_cast<int>(found - corners.begin());
}

}  // namespace

SurfacePoint surface_point(const SurfaceMesh& mesh, VertexId v) {
  const HalfedgeId h = mesh.halfedge(v);
  return surface_point(mesh, h, 0.0);
}

SurfacePoint surface_point(const SurfaceMesh& mesh, HalfedgeId h, double t) {
  if (mesh.is_boundary(h)) return surface_point(mesh, mesh.twin(h), 1.0 - t);
  SurfacePoint point{mesh.face(h), Vec3::Zero()};
  const int k = h - mesh.halfedge(point.face);
  point.barycentric[k] = 1.0 - t;
  point.barycentric[(k + 1) % 3] = t;
  return point;
}

Vec3 position(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& point) {
  const auto [a, b, c] = mesh.face_vertices(point.face);
  const Vec3& w = point.barycentric;
  return (w[0] * positions.row(a) + w[1] * positions.row(b) + w[2] * positions.row(c)).transpose();
}

bool lies_in(const SurfaceMesh& mesh, const SurfacePoint& point, FaceId face) {
  const auto corners = mesh.face_vertices(point.face);
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] != 0.0 && corner_of(mesh, face, corners[k]) < 0) return false;
  }
  return true;
}

std::vector<FaceId> faces_at(const SurfaceMesh& mesh, const SurfacePoint& point) {
  std::vector<FaceId> faces{point.face};
  const auto add = [&](FaceId f) {
    if (f.valid() && f != point.face && lies_in(mesh, point, f)) faces.push_back(f);
  };
  const Vec3& w = point.barycentric;
  const HalfedgeId h = mesh.halfedge(point.face);
  const HalfedgeId around[3] = {h, mesh.next(h), mesh.prev(h)};
  for (int k = 0; k < 3; ++k) {
    if (w[k] == 1.0) mesh.for_outgoing(mesh.from(around[k]), [&](HalfedgeId out) { add(mesh.face(out)); });
    if (w[k] != 0.0 && w[(k + 1) % 3] != 0.0 && w[(k + 2) % 3] == 0.0) add(mesh.face(mesh.twin(around[k])));
  }
  return faces;
}

SurfacePoint in_face(const SurfaceMesh& mesh, const SurfacePoint& point, FaceId face) {
  WILT_CHECK(lies_in(mesh, point, face), int(face), int(point.face), point.barycentric.transpose());
  if (face == point.face) return point;
  SurfacePoint result{face, Vec3::Zero()};
  const auto corners = mesh.face_vertices(point.face);
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] != 0.0)
      result.barycentric[corner_of(mesh, face, corners[k])] = point.barycentric[k];
  }
  return result;
}

FaceId common_face(const SurfaceMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
  for (const FaceId f : faces_at(mesh, a)) {
    if (lies_in(mesh, b, f)) return f;
  }
  return FaceId();
}

}  // namespace wilt
