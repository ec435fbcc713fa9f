// A front that carries the unfolded image of its source over a surface. Internal to the room.
#pragma once

#include <limits>
#include <vector>

#include "wilt/geodesics/unfolding.hpp"

namespace wilt::detail {

/// Near-exact distances, one face at a time, in Dijkstra's order.
///
/// Every vertex knows its root, the last vertex where its path bends, the root's own distance (offset) and
/// the direction in which it lies. A face with two finished vertices of one root finishes the third from the
/// front's centre in the plane, found by their distances and directions (after Novotni and Klein 2002, who
/// use the distances alone); with two roots, the line through both images tells which of them the third
/// vertex sees. Exact on flat convex surfaces.
class FastMarch {
 public:
  FastMarch(const SurfaceMesh& mesh, const Unfolding& unfolding);

  void add_source(VertexId v);

  /// A vertex whose nearest point of a curve lies at `distance` in direction `angle` (Unfolding::angle).
  void add_curve_point(VertexId v, double distance, double angle);

  void run();

  double distance(VertexId v) const { return states_[v].distance; }

 private:
  struct State {
    double distance = std::numeric_limits<double>::infinity();
    double offset = 0.0;  // the root's own distance
    double angle = 0.0;   // the direction of the root's image, once finished
    Vec2 image = Vec2::Zero();
    HalfedgeId halfedge;  // opposite the vertex, of the face that it was reached through: the image's frame
    int root = -1;
    bool finished = false;
  };
  struct Entry {
    double distance;
    VertexId vertex;
  };

  double bend(VertexId u, HalfedgeId out) const;
  double arrival_angle(VertexId v) const;
  Vec2 image_at_start(HalfedgeId h) const;
  Vec2 image_at_end(HalfedgeId h) const;
  void sweep(VertexId u);
  void along_edge(HalfedgeId h);
  void across(HalfedgeId h);
  void through(HalfedgeId h, const Vec2& image, double offset, VertexId like);
  void two_roots(HalfedgeId h);
  void curve(HalfedgeId h);
  void push(VertexId v, const State& state);

  const SurfaceMesh& mesh_;
  const Unfolding& unfolding_;
  std::vector<State> states_;
  std::vector<Entry> heap_;
};

}  // namespace wilt::detail
