// A half-edge triangle mesh with boundary; its topology never changes once built.
#pragma once

#include <array>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/elements.hpp"

namespace wilt {

/// An oriented, edge-manifold triangle mesh as flat arrays.
///
/// Halfedges 3f, 3f+1, 3f+2 belong to face f, in its order; those after 3 #F are on the boundary (no face)
/// and `next` runs along the boundary loop. Halfedge h points from `from(h)` to `to(h)`. Edges are numbered
/// in the order in which their first halfedge appears. An immutable value: copies share nothing, all reads
/// are safe from any thread.
class SurfaceMesh {
 public:
  SurfaceMesh() = default;

  /// Builds the connectivity of `faces` (#F x 3, counter-clockwise) over `vertex_count` vertices.
  ///
  /// Throws Error{input}, naming the faces and vertices concerned, for: no face, an index out of range, a
  /// face with a repeated vertex, an edge with more than two faces, two neighbours of opposite orientation, a
  /// vertex where several fans meet, a vertex that no face uses. O(#F log #F), deterministic.
  SurfaceMesh(int vertex_count, const Faces& faces);

  int num_vertices() const { return static_cast<int>(vertex_halfedge_.size()); }
  int num_edges() const { return static_cast<int>(edge_halfedge_.size()); }
  int num_faces() const { return static_cast<int>(faces_.rows()); }
  int num_halfedges() const { return static_cast<int>(next_.size()); }

  IdRange<VertexId> vertices() const { return IdRange<VertexId>(num_vertices()); }
  IdRange<EdgeId> edges() const { return IdRange<EdgeId>(num_edges()); }
  IdRange<FaceId> faces() const { return IdRange<FaceId>(num_faces()); }

  HalfedgeId next(HalfedgeId h) const { return next_[h]; }
  HalfedgeId prev(HalfedgeId h) const { return prev_[h]; }
  HalfedgeId twin(HalfedgeId h) const { return twin_[h]; }
  VertexId from(HalfedgeId h) const { return from_[h]; }
  VertexId to(HalfedgeId h) const { return from_[twin_[h]]; }
  EdgeId edge(HalfedgeId h) const { return edge_[h]; }
  FaceId face(HalfedgeId h) const {
    return h < 3 * num_faces() ? FaceId(h / 3) : FaceId();
  }  ///< invalid on the boundary

  /// An outgoing halfedge; for a boundary vertex, the boundary halfedge.
  HalfedgeId halfedge(VertexId v) const { return vertex_halfedge_[v]; }
  HalfedgeId halfedge(EdgeId e) const { return edge_halfedge_[e]; }  ///< one that has a face
  HalfedgeId halfedge(FaceId f) const { return HalfedgeId(3 * f); }

  bool is_boundary(HalfedgeId h) const { return h >= 3 * num_faces(); }
  bool is_boundary(EdgeId e) const { return is_boundary(twin(halfedge(e))); }
  bool is_boundary(VertexId v) const { return is_boundary(halfedge(v)); }

  std::array<VertexId, 3> face_vertices(FaceId f) const {
    return {VertexId(faces_(int(f), 0)), VertexId(faces_(int(f), 1)), VertexId(faces_(int(f), 2))};
  }
  std::array<VertexId, 2> edge_vertices(EdgeId e) const {
    return {from(edge_halfedge_[e]), to(edge_halfedge_[e])};
  }
  const Faces& face_matrix() const { return faces_; }  ///< #F x 3
  Edges edge_matrix() const;                           ///< #E x 2

  /// The outgoing halfedge after h, clockwise around from(h).
  HalfedgeId next_outgoing(HalfedgeId h) const { return next_[twin_[h]]; }

  /// Calls visit(HalfedgeId) for every outgoing halfedge of v, clockwise.
  template <class Visit>
  void for_outgoing(VertexId v, Visit&& visit) const {
    const HalfedgeId first = halfedge(v);
    HalfedgeId h = first;
    do {
      visit(h);
      h = next_outgoing(h);
    } while (h != first);
  }

  std::vector<VertexId> one_ring(VertexId v) const;

  /// Every boundary loop as its vertices in order, the interior of the mesh on the right-hand side
  /// (clockwise seen from the side to which the faces turn counter-clockwise).
  const std::vector<std::vector<VertexId>>& boundary_loops() const { return boundary_loops_; }

  /// The number of the connected component of each vertex, in 0 .. count-1.
  VertexData<int> components(int* count) const;

 private:
  Faces faces_;
  std::vector<HalfedgeId> next_, prev_, twin_;
  std::vector<VertexId> from_;
  std::vector<EdgeId> edge_;
  std::vector<HalfedgeId> vertex_halfedge_, edge_halfedge_;
  std::vector<std::vector<VertexId>> boundary_loops_;
};

}  // namespace wilt
