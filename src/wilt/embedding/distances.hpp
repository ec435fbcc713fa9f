// What every scaling asks of its distances and options (internal to the room).
#pragma once

#include "wilt/embedding/embedding.hpp"

namespace wilt::detail {

/// Throws Error{input} unless the matrix is square, at least 3 x 3, finite, >= 0 and symmetric (to 1e-9 of
/// its largest entry). O(#V^2).
void validate_distances(const Eigen::MatrixXd& distances);

/// Throws Error{input} for an entry that is not finite or is negative, naming its place. O(entries).
void validate_entries(const Eigen::MatrixXd& distances);

/// sum_{i<j} (|x_i - x_j| - D_ij)^2 / sum_{i<j} D_ij^2, in parallel, the same on any number of threads.
double normalised_stress(const Eigen::MatrixXd& distances, const Points2& points);

}  // namespace wilt::detail
