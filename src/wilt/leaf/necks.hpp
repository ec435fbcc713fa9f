// Parts of a blade too thin to mesh. Inside the leaf room only.
#pragma once

#include <vector>

#include "wilt/leaf/curves.hpp"

namespace wilt::detail {

/// Moves sampled margin points apart where the blade between them is thinner than `width`, so that needles
/// and necks keep triangles of a decent shape; no point moves by more than about half of it. Rings run with
/// the blade on their left. O(n) for points about a width apart.
void thicken_necks(std::vector<Polyline>& rings, double width);

}  // namespace wilt::detail
