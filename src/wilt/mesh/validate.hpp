// Whether a mesh can be a leaf.
#pragma once

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// Throws Error{input} unless the surface is one connected piece with a margin, finite positions (#V x 3), no
/// two vertices of an edge at one place and no face without area (relative to the mean face: 1e-12). The
/// message says what and where. Holes are allowed. O(#F).
void validate_blade(const SurfaceMesh& mesh, const Points3& positions);

}  // namespace wilt
