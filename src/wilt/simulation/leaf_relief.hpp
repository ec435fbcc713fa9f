// The relief of a blade that is finer than its mesh, as a normal map.
#pragma once

#include <Eigen/Core>

#include "wilt/core/image.hpp"
#include "wilt/simulation/blade_texels.hpp"

namespace wilt {

/// Tangent-space normals of the upper side as glTF wants them: x along u, y against v, z out; (n + 1) 127.5.
///
/// Of a height above the mesh: ridges of primary and secondary veins, the fine network, and tissue that sinks
/// between the tertiary veins and crinkles, the more the drier (`dryness` #V, 0 to 1). A drawing of what dry
/// leaves look like, not a result of the mechanics. Every texel is filled. Deterministic on any number of
/// threads.
Image leaf_relief(const BladeTexels& texels, const Eigen::VectorXd& dryness);

}  // namespace wilt
