// Smooth random fields in the plane of the leaf.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "wilt/core/types.hpp"

namespace wilt {

/// A random field of zero mean and unit variance: a sum of plane waves of random direction and phase whose
/// lengths scatter around `wavelength` (in the unit of `points`, #V x 2). Fixed by seed and purpose; depends
/// on position alone, not on the numbering of the vertices.
Eigen::VectorXd smooth_noise(const Points2& points, double wavelength, std::uint64_t seed,
                             std::string_view purpose);

}  // namespace wilt
