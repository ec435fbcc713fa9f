// Points and polylines on a surface.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// A point in a face, by barycentric coordinates in the order of the face's vertices (sum 1, each >= 0).
struct SurfacePoint {
  FaceId face;
  Vec3 barycentric = Vec3::Zero();
};

SurfacePoint surface_point(const SurfaceMesh& mesh, VertexId v);
Vec3 position(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& point);

/// A polyline on the surface; consecutive points share a face.
struct SurfacePath {
  std::vector<SurfacePoint> points;
  double length = 0.0;
};

}  // namespace wilt
