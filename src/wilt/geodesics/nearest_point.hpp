// The point of a triangle mesh that is nearest to a place.
#pragma once

#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

struct NearestPoint {
  SurfacePoint point;
  double distance = 0.0;
};

/// Of all points of `faces` (#F x 3, >= 1) with corners in `positions` (in space, or a plane with z = 0) the
/// nearest to `place`; of equals the one in the first face. Coordinates below 1e-9 become an exact 0, as
/// SurfacePoint has it on edges and at vertices. O(#F). Deterministic.
NearestPoint nearest_point(const Faces& faces, const Points3& positions, const Vec3& place);

}  // namespace wilt
