// A front of distance on its way over a face, whose image in the plane is that of its root. Internal to the
// room.
//
// Symbols, in the frame of halfedge h = (a, b), its face above with the apex c:
//   d, r   a vertex's distance, and its distance to its root, the last vertex where its path bends
//   t      the unit vector from a vertex towards where its path comes from
//   I      the front's centre below the edge; the root's image itself where the surface is flat
#pragma once

#include <cmath>
#include <limits>

#include "wilt/geodesics/march_surface.hpp"

namespace wilt::detail {

/// A front at a vertex.
struct Front {
  double distance = std::numeric_limits<double>::infinity();
  double radius = 0.0;       ///< r
  float x = 0.0F, y = 0.0F;  ///< t in the vertex's polar frame
  int root = -1;             ///< number of the vertex
  bool final = false;        ///< handed on to the neighbours
};

/// The root of what is reached straight from a curve; its images are nearest points on the curve.
constexpr int kCurve = -2;

// A ray may miss the edge by this much of its length; the error is of second order in the miss.
constexpr double kMiss = 1e-6;
// A vertex is reached anew only when its distance falls below this much of it: beyond an obtuse corner the
// straight path may come later than one along an edge.
constexpr double kGain = 1.0 - 1e-9;

/// Takes the offer when it is clearly nearer.
inline bool take(Front& best, const Front& offer) {
  if (!(offer.distance < kGain * best.distance)) return false;
  best = offer;
  return true;
}

/// Offers v the path to u and on along the edge u v; true when it was taken. Where it bends by more than
/// `bend` (the sine of an angle), u is the root.
inline bool along_edge(const Front& u, VertexId number, double bend, const MarchEdge& edge,
                       const MarchEdge& back, Front& v) {
  const double distance = u.distance + edge.length;
  if (!(distance < kGain * v.distance)) return false;
  const double ahead = -(u.x * edge.x + u.y * edge.y), aside = u.x * edge.y - u.y * edge.x;
  const bool straight = (ahead > 0.0 && std::abs(aside) <= bend) || u.radius <= kMiss * edge.length;
  v = {distance, straight ? u.radius + edge.length : edge.length, back.x, back.y,
       straight ? u.root : int(number)};
  return true;
}

/// Offers the apex of a face whose other vertices a and b are final what comes through the edge between; true
/// when it was taken. `edge` is a b, `back` is b a.
bool across_face(const Front& a, const Front& b, const MarchFace& face, const MarchEdge& edge,
                 const MarchEdge& back, Front& apex);

}  // namespace wilt::detail
