// Polylines in the plane: splines, even resampling, smoothing. Inside the rooms leaf, import and
// simulation only.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::detail {

using Polyline = std::vector<Vec2>;

inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The length of a polyline, or of a ring (its last point joined to its first).
double length_of(const Polyline& points, bool closed);

/// The area inside a ring, positive when it runs counter-clockwise.
double signed_area(const Polyline& ring);

/// Whether a point lies inside a ring (even-odd). O(n).
bool is_inside(const Polyline& ring, const Vec2& point);

/// A centripetal Catmull-Rom spline through the points (Barry and Goldman's recursion), `per_span` points per
/// span, its last point included. Two points give a straight line.
Polyline spline_through(const Polyline& points, int per_span);

/// `count` points at even arc length along a ring, the first one kept.
Polyline resample_ring(const Polyline& ring, int count);

/// Points at arc lengths at most `step` apart along an open polyline, both ends kept.
Polyline resample_open(const Polyline& points, double step);

/// Convolves a ring with the kernel (1/4, 1/2, 1/4) `rounds` times: with points a step apart a Gaussian of
/// standard deviation step * sqrt(rounds / 2). A discrete curve-shortening flow, under which simple curves
/// stay simple.
void smooth_ring(Polyline& ring, int rounds);

}  // namespace wilt::detail
