// The coordinates of the files that wilt writes.
#pragma once

#include <string>

#include "wilt/leaf/leaf.hpp"

namespace wilt {

// Leaf frame (metres, Z up) -> the leaf's placement -> Y up: (x, y, z) becomes (x, z, -y). With the identity
// placement of a built-in species: metres, the blade facing up, its apex towards -Z.

/// #N x 3 points in the leaf frame, as files hold them.
Points3 file_points(const Placement& placement, const Points3& points);

/// The inverse: #N x 3 points as files hold them, in the leaf frame.
Points3 leaf_points(const Placement& placement, const Points3& points);

/// #N x 3 unit vectors in the leaf frame, as files hold them.
Points3 file_normals(const Placement& placement, const Points3& normals);

/// Metres per unit of the files of this placement: 1 / scale.
double metres_per_unit(const Placement& placement);

/// "metres", or "0.01 metres" for a leaf that came from a file in centimetres.
std::string unit_name(const Placement& placement);

}  // namespace wilt
