// Where on a leaf's source each place of its margin is.
#pragma once

#include <vector>

#include "values.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/margin.hpp"

namespace wilt::web {

/// x, y of each point of the margin as LeafSource.petiole takes it: pixels of a photo, units of a drawing,
/// two coordinates of a mesh file, of a species millimetres in the leaf frame that it has before its petiole
/// is moved.
std::vector<double> petiole_places(const val& source, const Leaf& leaf, const MarginProfile& margin);

}  // namespace wilt::web
