// The faces of a mesh laid into the plane, one frame per halfedge. Internal to the room.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt::detail {

/// The plane of face(h): from(h) is the origin, to(h) lies at (length, 0), the third vertex at apex, above.
struct HalfedgeFrame {
  double length = 0.0;
  Vec2 apex = Vec2::Zero();
  Vec2 right = Vec2::Zero();  ///< unit vector from the apex to to(h)
  Vec2 left = Vec2::Zero();   ///< unit vector from from(h) to the apex
};

/// Coordinates of p in the frame whose x axis starts at `origin` with the unit vector `axis`.
inline Vec2 into_frame(const Vec2& p, const Vec2& origin, const Vec2& axis) {
  const Vec2 q = p - origin;
  return {q.dot(axis), axis.x() * q.y() - axis.y() * q.x()};
}

/// Where the ray from `source` (below the x axis) through p meets the x axis.
inline double meet_axis(const Vec2& source, const Vec2& p) {
  return source.x() + (p.x() - source.x()) * (-source.y() / (p.y() - source.y()));
}

/// Frames and angles of a mesh, made once per query object. Immutable.
class Unfolding {
 public:
  /// Throws Error{input} when positions are not #V x 3 and finite, or a face has no area.
  Unfolding(const SurfaceMesh& mesh, const Points3& positions);

  const HalfedgeFrame& frame(HalfedgeId h) const { return frames_[h]; }  ///< h not on the boundary
  double length(HalfedgeId h) const { return lengths_[h]; }

  /// The angle of outgoing halfedge h at from(h), clockwise from halfedge(from(h)), in [0, total_angle).
  double angle(HalfedgeId h) const { return angles_[h]; }
  double total_angle(VertexId v) const { return total_angles_[v]; }

  /// Whether a shortest path may bend at v: on the boundary, or more than 2 pi of surface around it.
  bool pseudo_source(VertexId v) const { return pseudo_source_[v]; }

  double mean_length() const { return mean_length_; }

 private:
  std::vector<HalfedgeFrame> frames_;
  std::vector<double> lengths_, angles_, total_angles_;
  std::vector<bool> pseudo_source_;
  double mean_length_ = 0.0;
};

/// Throws Error{input} when v is no vertex of the mesh; `what` names it.
void check_vertex(const SurfaceMesh& mesh, VertexId v, const char* what);

}  // namespace wilt::detail
