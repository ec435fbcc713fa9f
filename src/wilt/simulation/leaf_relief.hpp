// The relief of a blade that is finer than its mesh, as a normal map.
#pragma once

#include <Eigen/Core>

#include "wilt/core/image.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// Tangent-space normals of the upper side as glTF wants them: x along u, y against v, z out; (n + 1) 127.5.
///
/// Of a height above the mesh: ridges of primary and secondary veins, the fine network, and, the more the
/// drier
/// (`dryness` #V, 0 to 1), tissue that sinks between the tertiary veins and crinkles. A drawing of what dry
/// leaves look like, not a result of the mechanics. Covers and deterministic as leaf_texture(), with the same
/// `size`.
Image leaf_relief(const Leaf& leaf, const Venation& venation, const Eigen::VectorXd& dryness, int size);

}  // namespace wilt
