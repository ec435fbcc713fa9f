// A picture of the blade in its texture plane: pigments, veins down to the areoles, spots, a crisp rim.
#pragma once

#include <Eigen/Core>

#include "wilt/core/image.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/senescence.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// The upper side of the blade at a state of dryness (#V, 0 to 1), `size` texels on a side (16 to 8192, 0:
/// none), every texel filled. Linear colours are multiplied by `gain` (>= 1 per channel) and clipped to 1.
/// Empty when the skin cannot carry it (uv_raster.hpp). Deterministic on any number of threads. About 0.5 s
/// for 1024 texels on one core.
Image leaf_texture(const Leaf& leaf, const Venation& venation, const SenescencePattern& pattern,
                   const TissueColours& colours, const Eigen::VectorXd& dryness, const Vec3& gain, int size);

}  // namespace wilt
