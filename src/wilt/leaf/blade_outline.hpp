// The outline of an individual leaf of one of the six species.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "wilt/leaf/outline.hpp"

namespace wilt {

struct BladeOutline {
  Outline outline;         ///< counter-clockwise, the petiole first; one unit is about the leaf's length
  Vec2 petiole;            ///< the margin's first point, the origin
  std::vector<Vec2> tips;  ///< of the lobes, clockwise from the petiole; the apex lies on the y axis
};

/// Builds the margin from the nodes and teeth of presets/NAME.toml: splines through the nodes of each side,
/// teeth, and for each seed its own lengths and angles of lobes, teeth, asymmetry, bend and undulation.
/// Throws Error{input} for an unknown species and for "generic", which has no outline. Deterministic.
BladeOutline blade_outline(std::string_view species_name, std::uint64_t seed);

}  // namespace wilt
