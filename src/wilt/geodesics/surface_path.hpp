// Points and polylines on a surface.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// A point in a face, by barycentric coordinates in the order of the face's vertices (sum 1, each >= 0).
///
/// An exact 0 puts it on an edge, an exact 1 on a vertex; such a point belongs to every face around and may
/// name any of them.
struct SurfacePoint {
  FaceId face;
  Vec3 barycentric = Vec3::Zero();
};

SurfacePoint surface_point(const SurfaceMesh& mesh, VertexId v);

/// The point at `t` in [0, 1] from from(h) to to(h).
SurfacePoint surface_point(const SurfaceMesh& mesh, HalfedgeId h, double t);

Vec3 position(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& point);

/// Whether `face` holds the point, inside, on an edge or at a vertex.
bool lies_in(const SurfaceMesh& mesh, const SurfacePoint& point, FaceId face);

/// Every face that holds the point: one, the two of an edge, or all around a vertex.
std::vector<FaceId> faces_at(const SurfaceMesh& mesh, const SurfacePoint& point);

/// The same point by its coordinates in `face`, which must hold it (WILT_CHECK).
SurfacePoint in_face(const SurfaceMesh& mesh, const SurfacePoint& point, FaceId face);

/// The first face that holds both points; invalid when none does.
FaceId common_face(const SurfaceMesh& mesh, const SurfacePoint& a, const SurfacePoint& b);

/// A polyline on the surface; consecutive points share a face (`common_face`).
struct SurfacePath {
  std::vector<SurfacePoint> points;  ///< #K, from the first to the last
  double length = 0.0;               ///< in the unit of the surface's positions
};

}  // namespace wilt
