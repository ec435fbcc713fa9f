#include "wilt/simulation/state_archive.hpp"

#include <fmt/format.h>

#include "wilt/core/error.hpp"

namespace wilt {

const Eigen::MatrixXd& StateArchive::saved(const std::string& name, Eigen::Index rows,
                                           Eigen::Index columns) const {
  const auto found = from_->find(name);
  if (found == from_->end()) throw Error(ErrorCode::input, fmt::format("'{}' is missing", name));
  const Eigen::MatrixXd& values = found->second;
  if ((rows != Eigen::Dynamic && values.rows() != rows) || values.cols() != columns)
    throw Error(ErrorCode::input,
                fmt::format("'{}' has {} x {} numbers, this run {} x {}", name, values.rows(), values.cols(),
                            rows == Eigen::Dynamic ? values.rows() : rows, columns));
  return values;
}

void StateArchive::refuse_count(const std::string& name, double value) {
  throw Error(ErrorCode::input, fmt::format("'{}' holds {} where a count belongs", name, value));
}

}  // namespace wilt
