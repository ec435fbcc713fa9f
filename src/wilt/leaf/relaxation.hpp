// Moving the points of a triangulation so that its triangles become even. Inside the leaf room only.
#pragma once

#include <vector>

#include "wilt/leaf/triangulation.hpp"

namespace wilt::detail {

/// What may move: inner points freely, points of the margin a little and only into the blade.
enum class Mobility : char { inner, margin, fixed };

/// `sweeps` of optimal Delaunay triangulation (Chen and Xu 2004): each inner point goes to the area-weighted
/// mean of the circumcentres around it, then edges are flipped. Edges of length about `edge`. No triangle
/// turns over.
void relax(Triangulation& triangulation, Polyline& points, const std::vector<Mobility>& mobility, double edge,
           int sweeps);

/// Widens angles below `angle` (radians) by moving the corners of their triangles, a pattern search on the
/// smallest angle around a point, for at most `rounds` rounds. Returns the smallest angle reached.
double widen_angles(Triangulation& triangulation, Polyline& points, const std::vector<Mobility>& mobility,
                    double edge, double angle, int rounds);

/// The smallest angle of a triangle, radians; negative or zero when it is turned over or flat.
double smallest_corner(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace wilt::detail
