// The leaf that the page asks for: LeafSource of web/src/core/protocol.ts.
#pragma once

#include <string>
#include <vector>

#include "values.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt::web {

/// Makes it. Throws as make_leaf(), leaf_from_arrays() and leaf_from_drawing() do.
Leaf leaf_of(const val& source);

/// The leaf of a species, its petiole where it grows.
Leaf species_leaf(const val& source);

/// The species whose settings hold for it.
std::string preset_of(const val& source);

/// What `wilt simulate` would be given with --vertices and --seed.
std::vector<Assignment> given_with(const val& source);

}  // namespace wilt::web
