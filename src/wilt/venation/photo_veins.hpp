// Veins that a photo shows.
#pragma once

#include <vector>

#include "wilt/venation/venation.hpp"

namespace wilt {

/// The veins that the leaf's photo shows (Leaf::photo, its ridges), for with_drawn_veins(); empty when it has
/// none or does not show them clearly.
///
/// Cheapest ways from the petiole through the ridge map, a texel costing 1 / (0.06 + strength), to the tips
/// that were found and to smaller peaks of the margin: those that leave the petiole on their own along a
/// clear ridge are primary veins, so a peak whose way branches off another vein is no lobe, and a lobe that
/// the margin hardly shows is found. What branches off along a clear ridge is a secondary vein, as far as the
/// ridge goes. Secondary veins are sought towards all of the margin. Deterministic. O(#texels log #texels).
std::vector<DrawnVein> photo_veins(const Leaf& leaf, const Venation& found);

}  // namespace wilt
