// Teeth along a margin. Inside the leaf room only.
#pragma once

#include "wilt/core/random.hpp"
#include "wilt/leaf/curves.hpp"
#include "wilt/leaf/presets.hpp"

namespace wilt::detail {

/// Adds teeth to a piece of margin that runs from a sinus (or the petiole) to a tip; they point outwards, to
/// the right of the way when `outwards` is 1, to the left when -1, and lean towards the tip. Both ends stay.
Polyline add_teeth(const Polyline& run, double outwards, const TeethRule& rule, Random& random);

}  // namespace wilt::detail
