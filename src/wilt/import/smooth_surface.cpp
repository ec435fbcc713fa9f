#include "wilt/import/smooth_surface.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wilt/core/random.hpp"

namespace wilt::detail {
namespace {

constexpr double kMostCoefficients = 4000.0;
constexpr int kReweightings = 4;
constexpr double kTraceFactor = 2.0;      // in the score that chooses lambda
constexpr double kTukey = 4.685;          // in standard deviations
constexpr double kNormalMedian = 1.4826;  // standard deviation over the median of distances

using Matrix = Eigen::SparseMatrix<double>;
using Block = Eigen::Matrix<double, 16, 16>;
using Span = Eigen::Vector4d;

// The four cubic B-splines over a span, t from 0 to 1, and their derivatives by t.
Span basis(double t) {
  const double s = 1.0 - t;
  return Span(s * s * s, 3 * t * t * t - 6 * t * t + 4, 3 * s * s * s - 6 * s * s + 4, t * t * t) / 6.0;
}
Span basis_slope(double t) {
  const double s = 1.0 - t;
  return Span(-s * s, 3 * t * t - 4 * t, -3 * s * s + 4 * s, t * t) / 2.0;
}
Span basis_bend(double t) {
  return Span(1.0 - t, 3 * t - 2, 3 * (1.0 - t) - 2, t);
}

// Entry 4 j + i: basis i along u, j along v.
Eigen::Matrix<double, 16, 1> products(const Span& u, const Span& v) {
  Eigen::Matrix<double, 16, 1> all;
  for (int j = 0; j < 4; ++j) all.segment<4>(4 * j) = v[j] * u;
  return all;
}

// The thin plate's energy over one cell of width 1: Gauss's rule with four points is exact.
Block cell_energy() {
  const std::array<double, 4> at{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                 0.9305681557970263};
  const std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                     0.1739274225687269};
  Block energy = Block::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const auto uu = products(basis_bend(at[i]), basis(at[j]));
      const auto uv = products(basis_slope(at[i]), basis_slope(at[j]));
      const auto vv = products(basis(at[i]), basis_bend(at[j]));
      energy +=
          weight[i] * weight[j] * (uu * uu.transpose() + 2.0 * uv * uv.transpose() + vv * vv.transpose());
    }
  }
  return energy;
}

}  // namespace

// The cell of a place, where in it, and the sixteen coefficients that matter.
struct SmoothSurface::Place {
  int column, row;
  double u, v;
  int columns;
  int coefficient(int k) const { return (row + k / 4) * columns + column + k % 4; }
};

SmoothSurface::Place SmoothSurface::locate(const Vec2& uv) const {
  const Vec2 at = (uv - origin_) / step_;
  Place place;
  place.column = std::clamp(static_cast<int>(std::floor(at.x())), 0, columns_ - 4);
  place.row = std::clamp(static_cast<int>(std::floor(at.y())), 0, rows_ - 4);
  place.u = at.x() - place.column;
  place.v = at.y() - place.row;
  place.columns = columns_;
  return place;
}

Vec3 SmoothSurface::at(const Vec2& uv) const {
  const Place place = locate(uv);
  const auto weights = products(basis(place.u), basis(place.v));
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 16; ++k) sum += weights[k] * coefficients_.row(place.coefficient(k)).transpose();
  return sum;
}

SmoothSurface::SmoothSurface(Points2 uv, const Points3& points, double knot_spacing) : uv_(std::move(uv)) {
  const Vec2 low = uv_.colwise().minCoeff().transpose();
  const Vec2 size = uv_.colwise().maxCoeff().transpose() - low;
  step_ = std::max(knot_spacing, std::sqrt(size.x() * size.y() / kMostCoefficients));
  origin_ = low - Vec2::Constant(step_);  // a cell more on every side
  columns_ = static_cast<int>(size.x() / step_) + 6;
  rows_ = static_cast<int>(size.y() / step_) + 6;
  fit(points, true);
  project(points);
  fit(points, false);
}

namespace {

// The normal equations of the fit as dense blocks by cell, and their solution.
class System {
 public:
  System(int columns, int rows) : columns_(columns), rows_(rows) {
    const int cells = (columns - 3) * (rows - 3);
    blocks_.resize(static_cast<std::size_t>(cells));
    penalty_ = assembled(std::vector<Block>(static_cast<std::size_t>(cells), cell_energy()));
    solver_.analyzePattern(penalty_);
  }

  void clear() {
    std::fill(blocks_.begin(), blocks_.end(), Block::Zero());
    right_ = Points3::Zero(columns_ * rows_, 3);
  }
  template <class Place>
  void add(const Place& place, double weight, const Vec3& point) {
    const auto row = products(basis(place.u), basis(place.v));
    blocks_[place.row * (columns_ - 3) + place.column] += weight * row * row.transpose();
    for (int k = 0; k < 16; ++k) right_.row(place.coefficient(k)) += weight * row[k] * point.transpose();
  }
  void close() { data_ = assembled(blocks_); }

  Points3 solve(double lambda) {
    solver_.factorize(data_ + lambda * penalty_);
    return solver_.solve(Eigen::MatrixXd(right_));
  }

  // The trace of the hat matrix at the lambda that solve() had last.
  double trace() const {
    constexpr int kProbes = 8;
    Random random(1, "scan surface trace");
    Eigen::MatrixXd signs(data_.rows(), kProbes);
    for (int j = 0; j < kProbes; ++j) {
      for (Eigen::Index i = 0; i < signs.rows(); ++i) signs(i, j) = random.uniform() < 0.5 ? -1.0 : 1.0;
    }
    return signs.cwiseProduct(solver_.solve(data_ * signs)).sum() / kProbes;
  }

 private:
  Matrix assembled(const std::vector<Block>& blocks) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(256 * blocks.size());
    for (int cell = 0; cell < static_cast<int>(blocks.size()); ++cell) {
      const int column = cell % (columns_ - 3), row = cell / (columns_ - 3);
      const auto id = [&](int k) { return (row + k / 4) * columns_ + column + k % 4; };
      for (int a = 0; a < 16; ++a) {
        for (int b = 0; b < 16; ++b) entries.emplace_back(id(a), id(b), blocks[cell](a, b));
      }
    }
    Matrix matrix(columns_ * rows_, columns_ * rows_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  int columns_, rows_;
  std::vector<Block> blocks_;
  Matrix penalty_, data_;
  Points3 right_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

struct SmoothSurface::Fit {
  Fit(SmoothSurface& fitted, const Points3& given)
      : surface(fitted),
        points(given),
        system(fitted.columns_, fitted.rows_),
        weights(given.rows(), 1.0),
        distances(given.rows()) {}

  void assemble() {
    total = 0.0;
    for (const double weight : weights) total += weight;
    system.clear();
    for (int i = 0; i < points.rows(); ++i)
      system.add(surface.locate(surface.uv_.row(i).transpose()), weights[i] / total,
                 points.row(i).transpose());
    system.close();
  }

  // Returns the weighted sum of squared distances.
  double solve(double lambda) {
    surface.coefficients_ = system.solve(lambda);
    double squares = 0.0;
    for (int i = 0; i < points.rows(); ++i) {
      distances[i] = (surface.at(surface.uv_.row(i).transpose()) - points.row(i).transpose()).norm();
      squares += weights[i] * distances[i] * distances[i];
    }
    return squares;
  }

  double score(double exponent) {
    const double squares = solve(std::pow(10.0, exponent));
    const double left = 1.0 - kTraceFactor * system.trace() / total;
    return left > 0.0 ? squares / (left * left) : 1e300;
  }

  // By decades, then by halves of them.
  void choose_lambda() {
    double best = -6.0, least = 1e300;
    const auto try_one = [&](double exponent) {
      const double value = score(exponent);
      if (value >= least) return;
      least = value;
      best = exponent;
    };
    for (double exponent = -6.0; exponent <= 1.0; exponent += 1.0) try_one(exponent);
    const double middle = best;
    for (const double side : {-0.5, 0.5}) try_one(middle + side);
    surface.lambda_ = std::pow(10.0, best);
  }

  void reweight() {
    const double limit = kTukey * std::max(kNormalMedian * median(distances), 1e-12 * surface.step_);
    double squares = 0.0;
    int kept = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double t = distances[i] / limit;
      weights[i] = t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
      if (t >= 1.0) continue;
      squares += distances[i] * distances[i];
      ++kept;
    }
    surface.noise_ = std::sqrt(squares / kept);
    surface.outliers_ = 1.0 - kept / double(weights.size());
  }

  SmoothSurface& surface;
  const Points3& points;
  System system;
  std::vector<double> weights, distances;
  double total = 0.0;  // of the weights
};

void SmoothSurface::fit(const Points3& points, bool choose) {
  Fit fit(*this, points);
  for (int round = 0; round < kReweightings; ++round) {
    fit.assemble();
    if (choose && round == 1) fit.choose_lambda();
    fit.solve(lambda_);
    fit.reweight();
  }
}

// Gauss and Newton's step to the nearest place, half a knot spacing at most.
void SmoothSurface::project(const Points3& points) {
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Place place = locate(uv_.row(i).transpose());
    const auto by_u = products(basis_slope(place.u), basis(place.v));
    const auto by_v = products(basis(place.u), basis_slope(place.v));
    Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = 0; k < 16; ++k) {
      const Vec3 c = coefficients_.row(place.coefficient(k)).transpose();
      slopes.col(0) += by_u[k] * c / step_;
      slopes.col(1) += by_v[k] * c / step_;
    }
    const Vec3 arm = points.row(i).transpose() - at(uv_.row(i).transpose());
    Vec2 move = (slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * arm);
    if (!move.allFinite()) continue;
    move *= std::min(1.0, 0.5 * step_ / std::max(move.norm(), 1e-300));
    uv_.row(i) += move.transpose();
  }
}

}  // namespace wilt::detail
