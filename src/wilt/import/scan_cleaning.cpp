#include "wilt/import/scan_cleaning.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/import/point_index.hpp"
#include "wilt/import/scan_limits.hpp"

namespace wilt::detail {
namespace {

constexpr std::size_t kMostPoints = 40'000;
constexpr int kNeighbours = 12;
constexpr double kStray = 3.5;            // mean distance to the neighbours, in units of the median's
constexpr double kReach = 4.0;            // radius of a local fit in spacings at least,
constexpr double kNoiseReach = 5.0;       // and in units of the noise
constexpr std::size_t kMostFitted = 160;  // neighbours of a local fit

Points3 to_matrix(const std::vector<Vec3>& list) {
  Points3 points(static_cast<Eigen::Index>(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) points.row(i) = list[i].transpose();
  return points;
}

bool before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

std::vector<Vec3> distinct(const Points3& raw) {
  std::vector<Vec3> points(static_cast<std::size_t>(raw.rows()));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = raw.row(i).transpose();
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Every k-th point in that order: spread evenly along x, at random across.
std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::vector<std::string>& notes) {
  const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
  if (step <= 1) return points;
  std::vector<Vec3> some;
  for (std::size_t i = step / 2; i < points.size(); i += step) some.push_back(points[i]);
  notes.push_back(fmt::format("of {} points every {}th was used", points.size(), step));
  return some;
}

double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The mean distance of every point to its neighbours.
std::vector<double> crowding(const Points3& points, const PointIndex& index) {
  std::vector<double> mean(static_cast<std::size_t>(points.rows()));
  parallel_for(static_cast<int>(points.rows()), 256, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      double sum = 0.0;
      for (const int j : index.nearest(points.row(i).transpose(), kNeighbours + 1))
        sum += (points.row(j) - points.row(i)).norm();
      mean[i] = sum / kNeighbours;
    }
  });
  return mean;
}

// On a surface with one point per s^2, k points lie within r of a point where pi r^2 = k s^2; their mean
// distance is 2 r / 3.
double spacing_of(double mean_distance) {
  return 1.5 * mean_distance * std::sqrt(std::numbers::pi / kNeighbours);
}

struct LocalFit {
  Vec3 place, normal;
  double noise;  // root mean square distance of the neighbours
};

// z = a + b x + c y + d x^2 + e x y + f y^2 over the plane of the neighbours' principal axes.
LocalFit fit_locally(const Points3& points, const Vec3& at, const std::vector<int>& all, double radius) {
  std::vector<int> near;
  const std::size_t step = 1 + all.size() / kMostFitted;
  for (std::size_t i = 0; i < all.size(); i += step) near.push_back(all[i]);
  const auto weight = [&](int i) {
    return std::exp(-4.0 * (points.row(i).transpose() - at).squaredNorm() / (radius * radius));
  };
  Vec3 centre = Vec3::Zero();
  double total = 0.0;
  for (const int i : near) {
    centre += weight(i) * points.row(i).transpose();
    total += weight(i);
  }
  centre /= total;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int i : near) {
    const Vec3 arm = points.row(i).transpose() - centre;
    spread += weight(i) * arm * arm.transpose();
  }
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  const auto local = [&](const Vec3& p) -> Vec3 {  // x, y in the plane, z across it
    const Vec3 arm = axes.transpose() * (p - centre) / radius;
    return {arm[2], arm[1], arm[0]};
  };
  using Row = Eigen::Matrix<double, 6, 1>;
  const auto powers = [](const Vec3& q) {
    return Row(1.0, q.x(), q.y(), q.x() * q.x(), q.x() * q.y(), q.y() * q.y());
  };
  Eigen::Matrix<double, 6, 6> left = 1e-9 * total * Eigen::Matrix<double, 6, 6>::Identity();
  Row right = Row::Zero();
  for (const int i : near) {
    const Vec3 q = local(points.row(i).transpose());
    left += weight(i) * powers(q) * powers(q).transpose();
    right += weight(i) * q.z() * powers(q);
  }
  const Row shape = left.ldlt().solve(right);
  double squares = 0.0;
  for (const int i : near) {
    const Vec3 q = local(points.row(i).transpose());
    squares += weight(i) * std::pow(q.z() - shape.dot(powers(q)), 2);
  }
  const double count = static_cast<double>(near.size());
  const Vec3 here = local(at);
  const double slope_x = shape[1] + 2 * shape[3] * here.x() + shape[4] * here.y();
  const double slope_y = shape[2] + shape[4] * here.x() + 2 * shape[5] * here.y();
  LocalFit fit;
  fit.place = centre + radius * (axes * Vec3(shape.dot(powers(here)), here.y(), here.x()));
  fit.normal = (axes * Vec3(1.0, -slope_y, -slope_x)).normalized();
  fit.noise = radius * std::sqrt(squares / total * count / std::max(1.0, count - 6.0));
  return fit;
}

// Fills smooth and normals; returns the median noise.
double smooth_locally(CleanScan& scan, const PointIndex& index, double radius) {
  scan.smooth.resize(scan.points.rows(), 3);
  scan.normals.resize(scan.points.rows(), 3);
  std::vector<double> noise(static_cast<std::size_t>(scan.points.rows()));
  parallel_for(static_cast<int>(scan.points.rows()), 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Vec3 at = scan.points.row(i).transpose();
      std::vector<int> near = index.within(at, radius);
      if (near.size() < kNeighbours) near = index.nearest(at, kNeighbours);
      const LocalFit fit = fit_locally(scan.points, at, near, radius);
      scan.smooth.row(i) = fit.place.transpose();
      scan.normals.row(i) = fit.normal.transpose();
      noise[i] = fit.noise;
    }
  });
  return quantile(noise, 0.5);
}

void refuse_too_few(std::size_t count) {
  if (count >= kLeastScanPoints) return;
  throw Error(ErrorCode::input, fmt::format("{} points are too few; a scan of a leaf needs {} at least",
                                            count, kLeastScanPoints));
}

void refuse_a_line(const Points3& points) {
  const Points3 arms = points.rowwise() - points.colwise().mean();
  const Eigen::Matrix3d spread = arms.transpose() * arms;
  const Vec3 squared = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
  if (squared[1] > 1e-4 * squared[2]) return;
  throw Error(ErrorCode::input, "the points lie on a line; a scan of a leaf is points all over its surface");
}

}  // namespace

CleanScan clean_scan(const Points3& raw, std::vector<std::string>& notes) {
  refuse_too_few(static_cast<std::size_t>(raw.rows()));
  const std::vector<Vec3> single = distinct(raw);
  refuse_too_few(single.size());
  if (const auto repeated = static_cast<std::size_t>(raw.rows()) - single.size())
    notes.push_back(fmt::format("{} repeated points were left out", repeated));
  const Points3 all = to_matrix(thinned(single, notes));
  refuse_a_line(all);

  const std::vector<double> distances = crowding(all, PointIndex(all));
  const double limit = kStray * quantile(distances, 0.5);
  std::vector<Vec3> kept, strays;
  for (std::size_t i = 0; i < distances.size(); ++i)
    (distances[i] <= limit ? kept : strays).push_back(all.row(i).transpose());
  CleanScan scan;
  scan.points = to_matrix(kept);
  scan.strays = to_matrix(strays);

  const PointIndex index(scan.points);
  const double rough_spacing = spacing_of(quantile(distances, 0.5));
  double radius = kReach * rough_spacing;
  for (int round = 0; round < 4; ++round) {
    const double noise = smooth_locally(scan, index, radius);
    if (kNoiseReach * noise <= radius) break;
    radius *= 1.5;
  }
  const std::vector<double> settled = crowding(scan.smooth, PointIndex(scan.smooth));
  scan.spacing = spacing_of(quantile(settled, 0.5));
  scan.coarse_spacing = spacing_of(quantile(settled, 0.95));
  return scan;
}

}  // namespace wilt::detail
