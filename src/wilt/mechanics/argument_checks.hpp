// Checks of the arrays that terms are made from (internal).
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <string_view>

#include "wilt/core/error.hpp"

namespace wilt::detail {

/// Throws Error{configuration} unless `values` has `count` entries.
inline void require_count(std::string_view what, Eigen::Index count, Eigen::Index expected) {
  if (count != expected)
    throw Error(ErrorCode::configuration,
                fmt::format("{} {} given, but {} are needed: one per element", count, what, expected));
}

/// Throws Error{configuration}, naming the first entry that is not finite or not at least `minimum` (above it
/// when `strict`).
inline void require_values(std::string_view what, const Eigen::VectorXd& values, double minimum,
                           bool strict) {
  for (int i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (strict ? values[i] > minimum : values[i] >= minimum)) continue;
    throw Error(ErrorCode::configuration, fmt::format("{} {} is {}; it must be finite and {} {}", what, i,
                                                      values[i], strict ? "above" : "at least", minimum));
  }
}

template <class Derived>
void require_finite(std::string_view what, const Eigen::MatrixBase<Derived>& values) {
  for (int i = 0; i < values.rows(); ++i) {
    if (!values.row(i).allFinite())
      throw Error(ErrorCode::configuration, fmt::format("{} {} is not finite", what, i));
  }
}

}  // namespace wilt::detail
