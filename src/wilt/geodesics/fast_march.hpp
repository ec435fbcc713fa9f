// A front that runs over a surface from a vertex or a curve. Internal to the room.
#pragma once

#include <vector>

#include "wilt/geodesics/front.hpp"

namespace wilt::detail {

/// Near-exact distances, one face at a time, nearest vertices first.
///
/// Every vertex knows its root, the last vertex where its path bends, how far that is and the direction in
/// which the path comes. A face with two final vertices of one root reaches the third from the front's centre
/// in the plane, found by their distances and directions (after Novotni and Klein 2002, who use the distances
/// alone); with two roots, the line through both images tells which of them the third vertex sees. Exact on
/// flat convex surfaces, but for directions in single precision. Keeps its memory from one run to the next.
/// Keeps a reference to the surface.
class FastMarch {
 public:
  explicit FastMarch(const MarchSurface& surface);

  void add_source(VertexId v);

  /// from(h) has its nearest point of a curve at `offset` from it, in the frame of h.
  void add_curve_point(HalfedgeId h, const Vec2& offset);

  /// Writes the distance of every vertex, #V, and forgets the sources.
  void run(double* distances);

 private:
  struct Entry {
    int vertex, next;
  };

  void push(VertexId v);
  void sweep(VertexId u);
  void across(HalfedgeId h);

  const MarchSurface& surface_;
  double buckets_per_length_;
  std::vector<Front> fronts_;
  std::vector<int> buckets_;    // the first entry of each, or -1
  std::vector<Entry> entries_;  // lists
  int current_ = 0;
};

}  // namespace wilt::detail
