// How a stiff leaf comes to lie on a level table.
#pragma once

#include "wilt/core/types.hpp"

namespace wilt {

/// The rotation that a body makes when it is put down as it is and tips until it stands on three points.
///
/// `points` (#P x 3, Z up, P >= 1) is the body, `centre` its centre of mass. The body tips about its lowest
/// point, then about edges between points that touch the table, always towards the side where its centre
/// hangs over, until the centre is above the triangle of its contacts. O(#P) for each tip, at most 64 tips.
Eigen::Matrix3d resting_rotation(const Points3& points, const Vec3& centre);

}  // namespace wilt
