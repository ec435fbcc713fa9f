// What a march needs of a surface, in flat arrays. Internal to the room.
#pragma once

#include <vector>

#include "wilt/geodesics/unfolding.hpp"

namespace wilt::detail {

/// A halfedge. Its direction stands in the polar frame of its first vertex: counter-clockwise angles, those
/// of an interior vertex scaled to 2 pi. Directions are in single precision: a march is bound by memory.
struct MarchEdge {
  double length = 0.0;
  float x = 0.0F, y = 0.0F;  ///< unit vector
};

/// The face of a halfedge, in its frame (HalfedgeFrame).
struct MarchFace {
  double apex_x = 0.0, apex_y = 0.0;
  float turn_x = 0.0F,
        turn_y = 0.0F;  ///< times this, as complex numbers: from here to the apex's polar frame
};

/// Immutable; made once per query object. Keeps a reference to the mesh.
class MarchSurface {
 public:
  MarchSurface(const SurfaceMesh& surface_mesh, const Unfolding& unfolding);

  const SurfaceMesh& mesh() const { return mesh_; }
  const MarchEdge& edge(HalfedgeId h) const { return edges_[h]; }
  const MarchFace& face(HalfedgeId h) const { return faces_[h]; }  ///< h not on the boundary

  double mean_length() const { return mean_length_; }

 private:
  const SurfaceMesh& mesh_;
  std::vector<MarchEdge> edges_;
  std::vector<MarchFace> faces_;
  double mean_length_;
};

}  // namespace wilt::detail
