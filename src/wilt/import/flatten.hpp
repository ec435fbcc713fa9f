// A curved sheet laid out in the plane. Inside the import room only.
#pragma once

#include "wilt/core/types.hpp"
#include "wilt/leaf/outline.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt::detail {

/// The orthogonal projection onto the plane across the area vector (#V x 2, the upper side kept upwards).
Points2 project_to_plane(const SurfaceMesh& mesh, const Points3& positions);

/// The sheet's boundary loops in the plane: the longest in space is the margin.
Outline boundary_outline(const SurfaceMesh& mesh, const Points3& positions, const Points2& flat);

/// A one-to-one map into the plane (#V x 2): the projection where it folds nothing and shortens no face to
/// less than a fifth, else least squares conformal maps (Levy, Petitjean, Ray, Maillot 2002).
/// Throws Error{input} when that overlaps too. One sparse factorisation.
Points2 flatten_sheet(const SurfaceMesh& mesh, const Points3& positions);

}  // namespace wilt::detail
