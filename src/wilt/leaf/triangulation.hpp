// A planar triangulation whose edges can be flipped, and the one that fills an outline. Inside the rooms leaf
// and import only.
#pragma once

#include <array>
#include <vector>

#include "wilt/leaf/curves.hpp"

namespace wilt::detail {

/// Counter-clockwise triangles over fixed or moving points. Edge k of a triangle faces its corner k and runs
/// from corner k+1 to corner k+2; `across[t][k]` is the triangle beyond it, -1 at the border.
struct Triangulation {
  std::vector<std::array<int, 3>> corners;
  std::vector<std::array<int, 3>> across;
  std::vector<int> triangle_of;  ///< one triangle of each point, -1 for none

  int count() const { return static_cast<int>(corners.size()); }
  int corner_index(int triangle, int point) const;
  int edge_towards(int triangle, int neighbour) const;

  /// Replaces the diagonal `k` of the two triangles beside it by the other one; the quadrilateral is convex.
  void flip(int triangle, int k);

  /// Recomputes `across` and `triangle_of` from the corners. O(n).
  void connect(int point_count);
};

/// The unconstrained Delaunay triangulation of distinct points (Boost.Polygon's Voronoi diagram on integer
/// coordinates). O(n log n).
Triangulation delaunay(const Polyline& points);

/// The part of the plane between the rings (the first is the margin, the others are holes; indices into
/// points), as triangles with every ring segment an edge: Delaunay, missing segments recovered by flips
/// (Sloan 1993), what lies outside dropped. Throws Error{input} when a segment cannot be recovered.
Triangulation fill_rings(const Polyline& points, const std::vector<std::vector<int>>& rings);

/// Flips inner edges until the triangulation is Delaunay again (Lawson 1977). `points` are the corners'
/// places. Returns the number of flips.
int make_delaunay(Triangulation& triangulation, const Polyline& points);

/// Calls visit(triangle, corner index) for the triangles around a point; the border point's fan too. Returns
/// whether the fan is closed (an inner point).
template <class Visit>
bool for_fan(const Triangulation& t, int point, Visit&& visit) {
  const int first = t.triangle_of[static_cast<std::size_t>(point)];
  int triangle = first;
  do {
    const int k = t.corner_index(triangle, point);
    visit(triangle, k);
    triangle = t.across[static_cast<std::size_t>(triangle)][static_cast<std::size_t>((k + 1) % 3)];
  } while (triangle >= 0 && triangle != first);
  if (triangle == first) return true;
  triangle = first;
  while (true) {
    const int k = t.corner_index(triangle, point);
    triangle = t.across[static_cast<std::size_t>(triangle)][static_cast<std::size_t>((k + 2) % 3)];
    if (triangle < 0) return false;
    visit(triangle, t.corner_index(triangle, point));
  }
}

}  // namespace wilt::detail
