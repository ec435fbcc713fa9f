// The colour of a withering leaf, from its state.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// Linear RGB of the upper side, #V x 3, for a state of dryness (#V, 0 to 1).
///
/// A ramp fresh -> turning -> dry of the species' colours, run by local dryness; margin and tissue between
/// the veins go ahead, the veins stay behind and paler; smooth variation from the leaf's seed.
Points3 leaf_colours(const Leaf& leaf, const Venation& venation, const LeafColours& colours,
                     const Eigen::VectorXd& dryness);

/// 8-bit sRGB to linear RGB (IEC 61966-2-1).
Vec3 linear_rgb(const std::array<int, 3>& srgb);

}  // namespace wilt
