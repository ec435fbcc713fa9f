// A picture of the blade in its texture plane: pigments, veins down to the areoles, spots, a crisp rim.
#pragma once

#include <Eigen/Core>

#include "wilt/core/image.hpp"
#include "wilt/simulation/blade_texels.hpp"
#include "wilt/simulation/senescence.hpp"

namespace wilt {

/// The upper side of the blade at a state of dryness (#V, 0 to 1), every texel filled. Linear colours are
/// multiplied by `gain` (>= 1 per channel) and clipped to 1. Deterministic on any number of threads.
Image leaf_texture(const BladeTexels& texels, const SenescencePattern& pattern, const TissueColours& colours,
                   const Eigen::VectorXd& dryness, const Vec3& gain);

}  // namespace wilt
