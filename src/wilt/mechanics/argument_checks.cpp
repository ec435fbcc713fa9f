#include "wilt/mechanics/argument_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt::detail {

void require_count(std::string_view what, Eigen::Index count, Eigen::Index expected) {
  if (count != expected)
    throw Error(ErrorCode::configuration,
                fmt::format("{} {} given, but {} are needed: one per element", count, what, expected));
}

void require_values(std::string_view what, const Eigen::VectorXd& values, double minimum, bool strict) {
  for (int i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (strict ? values[i] > minimum : values[i] >= minimum)) continue;
    throw Error(ErrorCode::configuration, fmt::format("{} {} is {}; it must be finite and {} {}", what, i,
                                                      values[i], strict ? "above" : "at least", minimum));
  }
}

void require_finite(std::string_view what, const Eigen::Ref<const Eigen::MatrixXd>& values) {
  for (int i = 0; i < values.rows(); ++i) {
    if (!values.row(i).allFinite())
      throw Error(ErrorCode::configuration, fmt::format("{} {} is not finite; give finite numbers", what, i));
  }
}

}  // namespace wilt::detail
