// Secondary veins by a botanical rule (internal to the room).
#pragma once

#include <vector>

#include "wilt/venation/venation.hpp"

namespace wilt::detail {

/// The secondary veins of all `primaries`, by primary, then from its base to its tip.
///
/// Each primary vein has a territory, the points nearer to it than to another; `to_primary` (#primaries x #V)
/// holds the distances to each. Along a primary, left and right, a vein leaves every rule.spacing *
/// sqrt(area) at the rule's angle and bends towards the tip by rule.curvature in all. It ends a little before
/// the margin, the edge of its territory or another secondary vein, and is never longer than what is left of
/// its primary. Invariant to rigid motion and scale. Deterministic.
std::vector<Vein> secondary_veins(const SurfaceMesh& mesh, const Points3& positions,
                                  const std::vector<Vein>& primaries, const Eigen::MatrixXd& to_primary,
                                  const SecondaryVeinRule& rule);

}  // namespace wilt::detail
