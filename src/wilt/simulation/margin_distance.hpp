// How far every vertex lies from the rim of its blade.
#pragma once

#include <Eigen/Core>

#include "wilt/leaf/leaf.hpp"

namespace wilt {

/// Distance on the surface to the nearest boundary edge, #V, metres; holes have margins too. By
/// FastGeodesics. Deterministic. O(#V log #V).
Eigen::VectorXd margin_distance(const Leaf& leaf);

}  // namespace wilt
