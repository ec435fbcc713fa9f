// Walking straight on a surface.
#pragma once

#include <functional>

#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

/// The straightest path from `start` in the tangent direction `direction` (projected into the start's face),
/// turned left by `turn(s)` radians per unit length at arc length s (empty: straight), until `max_length`,
/// the margin, or `stop(point)` says so (empty: never).
///
/// Polthier and Schmies 1998: straight inside a face and across an edge; a vertex is passed on the side of
/// the face that the path would enter. A start on an edge or a vertex begins in the face around it into
/// which the direction points. With `turn`, steps are at most a tenth of the face's mean edge length, or
/// 1/500 of `max_length` where that is more. `stop` is
/// asked at every point after the first; the point at which it says so is the last. At the margin the path
/// ends, and holds the start alone when it begins there and points outwards.
///
/// Throws Error{input} when the start is not on the mesh or positions do not fit it, Error{configuration}
/// when the direction has no tangential part or max_length is not positive and finite. Deterministic.
SurfacePath trace_straight(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start,
                           const Vec3& direction, double max_length,
                           const std::function<double(double)>& turn = {},
                           const std::function<bool(const SurfacePoint&)>& stop = {});

/// A line drawn through `points` (>= 1): from each to the next straight ahead, aimed anew in every face,
/// which on a gently curved surface is the shortest way but for a part of second order. Points that coincide
/// count once. Stops at the last point reached when the way to the next leaves the surface (across a sinus or
/// a hole); `reached` counts the points. Throws as trace_straight does. Deterministic.
struct DrawnPath {
  SurfacePath path;
  int reached = 0;
};
DrawnPath trace_through(const SurfaceMesh& mesh, const Points3& positions,
                        const std::vector<SurfacePoint>& points);

}  // namespace wilt
