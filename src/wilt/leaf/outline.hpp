// A leaf's outline in the plane, and a mesh inside it.
#pragma once

#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// A simple polygon with holes: the blade seen from above.
struct Outline {
  Points2 margin;              ///< #M x 2, closed (the last point is not the first), any orientation
  std::vector<Points2> holes;  ///< each #H x 2
};

/// Throws Error{input} unless every ring has three points or more, is finite, does not cross itself or
/// another ring, and holes lie inside the margin. The message says which ring and which segments. O(n log n).
void validate_outline(const Outline& outline);

struct MeshingOptions {
  int vertices = 2000;           ///< wanted; met within 5 %. 200 to 1,000,000
  double smallest_angle = 0.35;  ///< radians (20 degrees): no triangle has a smaller one
  double smoothing = 1.0;        ///< of the margin, in 0.6 edges: finer details are lost; 0.3 to 4
  std::vector<Vec2> keep;        ///< points of the margin that must become vertices (the petiole, lobe tips)
};

struct PlanarMesh {
  SurfaceMesh mesh;
  Points2 positions;           ///< #V x 2
  std::vector<VertexId> kept;  ///< the vertices of MeshingOptions::keep, in its order
};

/// Fills the outline with even triangles of one size: margin sampled to the edge length (details finer than
/// an edge are smoothed away), hexagonal points inside, Delaunay triangulation (Boost.Polygon), relaxation.
/// Vertices are ordered for locality. Deterministic. Throws Error{input} when the outline cannot be meshed.
PlanarMesh mesh_outline(const Outline& outline, const MeshingOptions& options, const Monitor& monitor = {});

}  // namespace wilt
