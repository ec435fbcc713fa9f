// Lengths, areas, angles and normals of a mesh with given positions.
#pragma once

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

// In all of them `positions` is #V x 3; results are in its unit, angles in radians. O(#F), deterministic.

EdgeData<double> edge_lengths(const SurfaceMesh& mesh, const Points3& positions);
double mean_edge_length(const SurfaceMesh& mesh, const Points3& positions);
FaceData<double> face_areas(const SurfaceMesh& mesh, const Points3& positions);
double surface_area(const SurfaceMesh& mesh, const Points3& positions);

/// A third of the area of the faces around each vertex: its lumped share of the surface.
VertexData<double> vertex_areas(const SurfaceMesh& mesh, const Points3& positions);

/// Area-weighted unit normals, #V x 3; the upper (adaxial) side is the one seen counter-clockwise.
Points3 vertex_normals(const SurfaceMesh& mesh, const Points3& positions);

/// The area vector of the surface: half the sum of the faces' cross products.
Vec3 area_vector(const Faces& faces, const Points3& positions);
Vec3 area_vector(const SurfaceMesh& mesh, const Points3& positions);

/// The smallest angle of any triangle, radians.
double smallest_angle(const SurfaceMesh& mesh, const Points3& positions);

/// The signed dihedral angle at an interior edge: 0 when flat, positive when the faces fold away from
/// their normals (a ridge seen from the upper side), in (-pi, pi]. 0 on the boundary.
double dihedral_angle(const SurfaceMesh& mesh, const Points3& positions, EdgeId edge);

/// The length of the closed polyline through the vertices of `loop`.
double loop_length(const Points3& positions, const std::vector<VertexId>& loop);

/// The margin: the longest boundary loop. Throws Error{input} when the mesh is closed.
const std::vector<VertexId>& margin_loop(const SurfaceMesh& mesh, const Points3& positions);

}  // namespace wilt
