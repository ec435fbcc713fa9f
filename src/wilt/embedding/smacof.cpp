// SMACOF, scaling by majorising a complicated function (de Leeuw 1977), with unit weights.
//
//   D_ij     wanted distances
//   d_ij(X)  |x_i - x_j|
//   sigma    sum_{i<j} (d_ij(X) - D_ij)^2, the raw stress
//   X+       Guttman transform: x_i+ = 1/n sum_j D_ij / d_ij (x_i - x_j), a minimiser of a function that lies
//            above sigma and touches it at X, so sigma(X+) <= sigma(X)
//
// One pass over D gives both sigma(X) and X+. D is symmetric, so its columns serve as rows.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "wilt/core/parallel.hpp"
#include "wilt/embedding/distances.hpp"

namespace wilt {
namespace {

constexpr int kLanes = 4;         // fixed, so that sums round alike on every processor
constexpr int kRows = 16;         // rows of a parallel block
constexpr double kTiny = 1e-300;  // added to squared distances: coincident points attract nothing
using Lanes = Eigen::Array<double, kLanes, 1>;

struct Plane {
  Eigen::ArrayXd x, y;
};

struct RowSums {
  double x = 0.0, y = 0.0;  ///< sum_j D_ij / d_ij (x_i - x_j)
  double stress = 0.0;      ///< sum_j (d_ij - D_ij)^2
};

RowSums sum_row(const double* distances, const Plane& points, int i) {
  const int n = static_cast<int>(points.x.size());
  const double xi = points.x(i), yi = points.y(i);
  Lanes sum_x = Lanes::Zero(), sum_y = Lanes::Zero(), sum_stress = Lanes::Zero();
  int j = 0;
  for (; j + kLanes <= n; j += kLanes) {
    const Lanes wanted = Eigen::Map<const Lanes>(distances + j);
    const Lanes dx = xi - Eigen::Map<const Lanes>(points.x.data() + j);
    const Lanes dy = yi - Eigen::Map<const Lanes>(points.y.data() + j);
    const Lanes d = (dx * dx + dy * dy + kTiny).sqrt();
    const Lanes ratio = wanted / d;
    const Lanes error = d - wanted;
    sum_x += ratio * dx;
    sum_y += ratio * dy;
    sum_stress += error * error;
  }
  RowSums sums{sum_x.sum(), sum_y.sum(), sum_stress.sum()};
  for (; j < n; ++j) {
    const double dx = xi - points.x(j), dy = yi - points.y(j);
    const double d = std::sqrt(dx * dx + dy * dy + kTiny);
    sums.x += distances[j] / d * dx;
    sums.y += distances[j] / d * dy;
    sums.stress += (d - distances[j]) * (d - distances[j]);
  }
  return sums;
}

/// Writes the Guttman transform of `points` and returns twice their raw stress.
double guttman_transform(const Eigen::MatrixXd& distances, const Plane& points, Plane& transformed) {
  const int n = static_cast<int>(distances.rows());
  return parallel_sum(n, kRows, [&](int begin, int end) {
    double stress = 0.0;
    for (int i = begin; i < end; ++i) {
      const RowSums sums = sum_row(distances.col(i).data(), points, i);
      transformed.x(i) = sums.x / n;
      transformed.y(i) = sums.y / n;
      stress += sums.stress;
    }
    return stress;
  });
}

void validate(const Eigen::MatrixXd& distances, const Points2& start, const SmacofOptions& options) {
  detail::validate_distances(distances);
  if (start.rows() != distances.rows() || !start.allFinite())
    throw Error(
        ErrorCode::input,
        fmt::format("smacof: the start has {} points{}; it must have one finite point for each of the {} "
                    "rows of the distance matrix",
                    start.rows(), start.allFinite() ? "" : ", some not finite", distances.rows()));
  if (options.max_iterations < 1)
    throw Error(ErrorCode::configuration,
                fmt::format("smacof: max_iterations = {}; it must be at least 1", options.max_iterations));
  if (!(options.tolerance > 0.0))
    throw Error(ErrorCode::configuration,
                fmt::format("smacof: tolerance = {}; it must be positive", options.tolerance));
}

}  // namespace

Embedding smacof(const Eigen::MatrixXd& distances, const Points2& start, const SmacofOptions& options,
                 const Monitor& monitor) {
  validate(distances, start, options);
  const double scale = distances.squaredNorm();
  const double normalise = scale > 0.0 ? 1.0 / scale : 0.0;
  Plane before{start.col(0), start.col(1)};
  Plane now = before, next = before;
  double stress = normalise * guttman_transform(distances, before, now);

  Embedding result;
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    monitor.throw_if_cancelled();
    const double reached = normalise * guttman_transform(distances, now, next);
    if (!(reached < stress)) break;  // nothing but round-off is left: keep what was before
    const bool converged = stress - reached <= options.tolerance * stress;
    stress = reached;
    result.history.push_back(stress);
    std::swap(before, now);
    std::swap(now, next);
    monitor.report("embedding", static_cast<double>(iteration) / options.max_iterations);
    if (converged) break;
  }
  result.coordinates.resize(distances.rows(), 2);
  result.coordinates.col(0) = before.x;
  result.coordinates.col(1) = before.y;
  result.stress = stress;
  return result;
}

}  // namespace wilt
