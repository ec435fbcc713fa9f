// SMACOF, scaling by majorising a complicated function (de Leeuw 1977), with unit weights.
//
//   D_ij     wanted distances
//   d_ij(X)  |x_i - x_j|
//   sigma    sum_{i<j} (d_ij(X) - D_ij)^2, the raw stress
//   X+       Guttman transform: x_i+ = 1/n sum_j D_ij / d_ij (x_i - x_j), a minimiser of a function that lies
//            above sigma and touches it at X, so sigma(X+) <= sigma(X)
//
// One pass over half of D gives both sigma(X) and X+: what a pair adds to x_i+ it takes from x_j+. The half
// is cut into bands of rows with sums of their own, added in one order.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/simd.hpp"
#include "wilt/embedding/distances.hpp"

namespace wilt {
namespace {

constexpr int kRows = 4;    // rows that are taken at once
constexpr int kBands = 16;  // fixed, so that sums round alike on any number of threads

/// Padded with zeros to whole vectors.
struct Plane {
  explicit Plane(int count) : x(padded(count), 0.0), y(padded(count), 0.0) {}
  static std::size_t padded(int count) { return (count + simd::kLanes - 1) / simd::kLanes * simd::kLanes; }

  std::vector<double> x, y;
};

/// The sums of a band: sum_j D_ij / d_ij (x_i - x_j), and the raw stress of its pairs.
struct Band {
  explicit Band(int count) : forces(count) {}

  Plane forces;
  double stress = 0.0;
};

/// `rows` rows of D against the points from `begin` (a multiple of the lanes) on: adds to the forces on both.
/// A row's own distance and those before it count as nothing.
template <int kCount>
WILT_INLINE void add_rows(const Eigen::MatrixXd& distances, const Plane& points, int row, Band& band) {
  const int n = static_cast<int>(distances.rows()), lanes = simd::kLanes;
  Double8 x[kCount], y[kCount], sum_x[kCount], sum_y[kCount], stress{};
  for (int k = 0; k < kCount; ++k) {
    x[k] = Double8{} + points.x[row + k];
    y[k] = Double8{} + points.y[row + k];
    sum_x[k] = sum_y[k] = Double8{};
  }
  // Every lambda here is inlined by force: vectors are handed over differently in code for other processors.
  const auto pairs = [&](int j, auto wanted_of, auto counts) __attribute__((always_inline)) {
    const Double8 other_x = simd::load(&points.x[j]), other_y = simd::load(&points.y[j]);
    Double8 pull_x = simd::load(&band.forces.x[j]), pull_y = simd::load(&band.forces.y[j]);
    for (int k = 0; k < kCount; ++k) {
      const Double8 dx = x[k] - other_x, dy = y[k] - other_y;
      const Double8 wanted = wanted_of(k), d = simd::sqrt(dx * dx + dy * dy + simd::kTiny);
      const Double8 ratio = wanted / d, error = counts(k, d - wanted);
      const Double8 force_x = ratio * dx, force_y = ratio * dy;
      sum_x[k] += force_x;
      sum_y[k] += force_y;
      pull_x -= force_x;
      pull_y -= force_y;
      stress += error * error;
    }
    simd::store(&band.forces.x[j], pull_x);
    simd::store(&band.forces.y[j], pull_y);
  };
  // Where a vector holds points up to the last row, or beyond the last point, lane by lane.
  const auto some = [&](int j) __attribute__((always_inline)) {
    const auto counts = [&](int k, int l) { return j + l > row + k && j + l < n; };
    pairs(
        j,
        [&](int k) __attribute__((always_inline)) {
          Double8 wanted{};
          for (int l = 0; l < lanes; ++l)
            if (counts(k, l)) wanted[l] = distances(j + l, row + k);
          return wanted;
        },
        [&](int k, Double8 error) __attribute__((always_inline)) {
          for (int l = 0; l < lanes; ++l)
            if (!counts(k, l)) error[l] = 0.0;
          return error;
        });
  };
  const int first = row / lanes * lanes, whole = n / lanes * lanes;
  int j = first;
  for (; j < std::min(whole, first + 2 * lanes); j += lanes) some(j);
  for (; j < whole; j += lanes)
    pairs(
        j, [&](int k) __attribute__((always_inline)) { return simd::load(&distances(j, row + k)); },
        [](int, Double8 error) __attribute__((always_inline)) { return error; });
  if (j < n) some(j);
  for (int k = 0; k < kCount; ++k) {
    band.forces.x[row + k] += simd::sum(sum_x[k]);
    band.forces.y[row + k] += simd::sum(sum_y[k]);
  }
  band.stress += simd::sum(stress);
}

WILT_CLONES void add_band(const Eigen::MatrixXd& distances, const Plane& points, int begin, int end,
                          Band& band) {
  int row = begin;
  for (; row + kRows <= end; row += kRows) add_rows<kRows>(distances, points, row, band);
  for (; row < end; ++row) add_rows<1>(distances, points, row, band);
}

/// The Guttman transform of points in the plane.
class Majorisation {
 public:
  explicit Majorisation(const Eigen::MatrixXd& distances)
      : distances_(distances), bands_(kBands, Band(static_cast<int>(distances.rows()))) {}

  /// Writes points + relaxation (their transform - points), and returns their raw stress.
  double step(const Plane& points, double relaxation, Plane& moved) {
    parallel_for(kBands, 1, [&](int begin, int end) {
      for (int b = begin; b < end; ++b) fill(points, b);
    });
    add_up(points.x, relaxation, &Plane::x, moved.x);
    add_up(points.y, relaxation, &Plane::y, moved.y);
    double stress = 0.0;
    for (const Band& band : bands_) stress += band.stress;
    return stress;
  }

 private:
  void add_up(const std::vector<double>& points, double relaxation, std::vector<double> Plane::*axis,
              std::vector<double>& moved) const {
    moved = bands_[0].forces.*axis;
    for (int b = 1; b < kBands; ++b) {
      const std::vector<double>& forces = bands_[b].forces.*axis;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += forces[i];
    }
    const double share = relaxation / static_cast<double>(distances_.rows());
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = (1.0 - relaxation) * points[i] + share * moved[i];
  }

  // Bands hold about equally many pairs: the first rows have the most.
  int first_row(int band) const {
    const double n = static_cast<double>(distances_.rows());
    return static_cast<int>(std::lround(n * (1.0 - std::sqrt(1.0 - static_cast<double>(band) / kBands))));
  }

  void fill(const Plane& points, int b) {
    Band& band = bands_[b];
    std::fill(band.forces.x.begin(), band.forces.x.end(), 0.0);
    std::fill(band.forces.y.begin(), band.forces.y.end(), 0.0);
    band.stress = 0.0;
    add_band(distances_, points, first_row(b), first_row(b + 1), band);
  }

  const Eigen::MatrixXd& distances_;
  std::vector<Band> bands_;
};

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
  if (!(options.relaxation >= 1.0 && options.relaxation < 2.0))
    throw Error(
        ErrorCode::configuration,
        fmt::format("smacof: relaxation = {}; it must be at least 1 and below 2", options.relaxation));
}

}  // namespace

Embedding smacof(const Eigen::MatrixXd& distances, const Points2& start, const SmacofOptions& options,
                 const Monitor& monitor) {
  validate(distances, start, options);
  const int n = static_cast<int>(distances.rows());
  const double scale = distances.squaredNorm();
  const double normalise = scale > 0.0 ? 2.0 / scale : 0.0;
  Plane before(n);
  for (int i = 0; i < n; ++i) {
    before.x[i] = start(i, 0);
    before.y[i] = start(i, 1);
  }
  Plane now = before, next = before;
  Majorisation majorisation(distances);
  double stress = normalise * majorisation.step(before, options.relaxation, now);

  Embedding result;
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    monitor.throw_if_cancelled();
    const double reached = normalise * majorisation.step(now, options.relaxation, next);
    if (!(reached < stress)) break;  // nothing but round-off is left: keep what was before
    const bool converged = stress - reached <= options.tolerance * stress;
    stress = reached;
    result.history.push_back(stress);
    std::swap(before, now);
    std::swap(now, next);
    monitor.report("embedding", static_cast<double>(iteration) / options.max_iterations);
    if (converged) break;
  }
  result.coordinates.resize(n, 2);
  for (int i = 0; i < n; ++i) result.coordinates.row(i) << before.x[i], before.y[i];
  result.stress = stress;
  return result;
}

}  // namespace wilt
