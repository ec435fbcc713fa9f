#include "wilt/embedding/distances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"

namespace wilt::detail {
namespace {

constexpr int kTile = 64;            // entries; two tiles stay in the first cache
constexpr double kAsymmetry = 1e-9;  // of the largest entry

void validate_symmetry(const Eigen::MatrixXd& distances) {
  const int n = static_cast<int>(distances.rows());
  const double allowed = kAsymmetry * distances.maxCoeff();
  for (int column = 0; column < n; column += kTile) {
    for (int row = column; row < n; row += kTile) {
      const int rows = std::min(kTile, n - row), columns = std::min(kTile, n - column);
      const Eigen::MatrixXd difference = distances.block(row, column, rows, columns) -
                                         distances.block(column, row, columns, rows).transpose();
      int i = 0, j = 0;
      if (difference.cwiseAbs().maxCoeff(&i, &j) <= allowed) continue;
      throw Error(
          ErrorCode::input,
          fmt::format("distance matrix: D({0}, {1}) = {2} but D({1}, {0}) = {3}; it must be symmetric: "
                      "average it with its transpose",
                      row + i, column + j, distances(row + i, column + j), distances(column + j, row + i)));
    }
  }
}

}  // namespace

void validate_entries(const Eigen::MatrixXd& distances) {
  for (Eigen::Index j = 0; j < distances.cols(); ++j) {
    for (Eigen::Index i = 0; i < distances.rows(); ++i) {
      const double d = distances(i, j);
      if (d >= 0.0 && std::isfinite(d)) continue;
      throw Error(ErrorCode::input,
                  fmt::format("distance matrix: D({}, {}) = {}; distances must be finite and >= 0 (is the "
                              "surface in one piece?)",
                              i, j, d));
    }
  }
}

void validate_distances(const Eigen::MatrixXd& distances) {
  if (distances.rows() != distances.cols())
    throw Error(ErrorCode::input, fmt::format("distance matrix: it is {} x {}; it must be square",
                                              distances.rows(), distances.cols()));
  if (distances.rows() < 3)
    throw Error(ErrorCode::input,
                fmt::format("distance matrix: {} points; an embedding needs 3 or more", distances.rows()));
  validate_entries(distances);
  validate_symmetry(distances);
}

double normalised_stress(const Eigen::MatrixXd& distances, const Points2& points) {
  const Eigen::ArrayXd x = points.col(0), y = points.col(1);
  const int n = static_cast<int>(points.rows());
  const double raw = parallel_sum(n, 16, [&](int begin, int end) {
    double sum = 0.0;
    for (int i = begin; i < end; ++i)
      sum += (((x - x(i)).square() + (y - y(i)).square()).sqrt() - distances.col(i).array()).square().sum();
    return sum;
  });
  const double scale = distances.squaredNorm();
  return scale > 0.0 ? raw / scale : 0.0;
}

}  // namespace wilt::detail
