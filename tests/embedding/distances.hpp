// Distance matrices with known properties, for the tests of the embedding.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/random.hpp"
#include "wilt/core/types.hpp"

namespace wilt::test {

/// `count` points evenly at random in [0, width] x [0, 1].
inline Points2 scattered(int count, double width, std::uint64_t seed) {
  Random random(seed, "scattered");
  Points2 points(count, 2);
  for (int i = 0; i < count; ++i) {
    points(i, 0) = random.uniform(0.0, width);
    points(i, 1) = random.uniform();
  }
  return points;
}

inline Eigen::MatrixXd euclidean_distances(const Points2& points) {
  Eigen::MatrixXd distances(points.rows(), points.rows());
  for (Eigen::Index j = 0; j < points.rows(); ++j)
    distances.col(j) = (points.rowwise() - points.row(j)).rowwise().norm();
  return distances;
}

/// Great-circle distances between the points of a unit sphere with latitude and longitude x and y: no plane
/// has them.
inline Eigen::MatrixXd spherical_distances(const Points2& angles) {
  Eigen::MatrixXd distances(angles.rows(), angles.rows());
  const auto on_sphere = [&](Eigen::Index i) {
    return Vec3(std::cos(angles(i, 0)) * std::cos(angles(i, 1)),
                std::cos(angles(i, 0)) * std::sin(angles(i, 1)), std::sin(angles(i, 0)));
  };
  for (Eigen::Index j = 0; j < angles.rows(); ++j) {
    for (Eigen::Index i = 0; i <= j; ++i) {
      const Vec3 a = on_sphere(i), b = on_sphere(j);
      distances(i, j) = distances(j, i) = std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  return distances;
}

/// The largest distance between `points` and `reference` after the best rotation, reflection and shift.
inline double procrustes_error(const Points2& points, const Points2& reference) {
  const Points2 a = points.rowwise() - points.colwise().mean();
  const Points2 b = reference.rowwise() - reference.colwise().mean();
  const Eigen::Matrix2d cross = a.transpose() * b;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix2d rotation = svd.matrixU() * svd.matrixV().transpose();
  return (a * rotation - b).rowwise().norm().maxCoeff();
}

}  // namespace wilt::test
