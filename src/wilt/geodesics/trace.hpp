// Walking straight on a surface.
#pragma once

#include <functional>

#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

/// The straightest path from `start` in the tangent direction `direction` (projected into the start's face),
/// turned left by `turn(s)` radians per unit length at arc length s (empty: straight), until `max_length`,
/// the margin, or `stop(point)` says so (empty: never).
SurfacePath trace_straight(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start,
                           const Vec3& direction, double max_length,
                           const std::function<double(double)>& turn = {},
                           const std::function<bool(const SurfacePoint&)>& stop = {});

}  // namespace wilt
