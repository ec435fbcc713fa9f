// Checks of the arrays that terms are made from (internal).
#pragma once

#include <Eigen/Core>
#include <string_view>

namespace wilt::detail {

/// Throws Error{configuration} unless `count` is `expected`.
void require_count(std::string_view what, Eigen::Index count, Eigen::Index expected);

/// Throws Error{configuration}, naming the first entry that is not finite or not at least `minimum` (above it
/// when `strict`).
void require_values(std::string_view what, const Eigen::VectorXd& values, double minimum, bool strict);

/// Throws Error{configuration}, naming the first row that is not finite.
void require_finite(std::string_view what, const Eigen::Ref<const Eigen::MatrixXd>& values);

}  // namespace wilt::detail
