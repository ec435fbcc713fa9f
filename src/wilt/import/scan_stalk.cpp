#include "wilt/import/scan_stalk.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wilt/import/point_index.hpp"

namespace wilt::detail {
namespace {

constexpr std::size_t kLeastPoints = 6;
constexpr double kLeastLength = 0.25;    // in units of the blade's size
constexpr double kMostThickness = 0.25;  // standard deviation across over along
constexpr double kLeadsAway = 0.5;       // distance of its end from the margin over that from its foot

std::vector<std::vector<int>> clusters(const Points3& points, double reach) {
  const PointIndex index(points);
  std::vector<char> seen(points.rows(), 0);
  std::vector<std::vector<int>> result;
  for (int start = 0; start < points.rows(); ++start) {
    if (std::exchange(seen[start], 1)) continue;
    std::vector<int> cluster{start};
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      for (const int j : index.within(points.row(cluster[k]).transpose(), reach)) {
        if (!std::exchange(seen[j], 1)) cluster.push_back(j);
      }
    }
    result.push_back(std::move(cluster));
  }
  return result;
}

bool is_thin(const Points3& points, const std::vector<int>& cluster) {
  Vec3 centre = Vec3::Zero();
  for (const int i : cluster) centre += points.row(i).transpose() / double(cluster.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int i : cluster) {
    const Vec3 arm = points.row(i).transpose() - centre;
    spread += arm * arm.transpose();
  }
  const Vec3 squared = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
  return squared[1] <= kMostThickness * kMostThickness * squared[2];
}

}  // namespace

std::optional<int> find_stalk_trail(const Points3& loose, const Points3& margin, double reach, double size) {
  if (loose.rows() == 0) return std::nullopt;
  const PointIndex index(margin);
  const auto to_margin = [&](int i) {  // the nearest margin point and its distance
    const int nearest = index.nearest(loose.row(i).transpose(), 1).front();
    return std::pair((margin.row(nearest) - loose.row(i)).norm(), nearest);
  };
  std::optional<int> best;
  double longest = kLeastLength * size;
  for (const std::vector<int>& cluster : clusters(loose, reach)) {
    if (cluster.size() < kLeastPoints || !is_thin(loose, cluster)) continue;
    std::pair<double, int> foot{1e300, -1};
    for (const int i : cluster) foot = std::min(foot, to_margin(i));
    if (foot.first > reach) continue;
    double length = 0.0, away = 0.0;
    for (const int i : cluster) {
      length = std::max(length, (loose.row(i) - margin.row(foot.second)).norm());
      away = std::max(away, to_margin(i).first);
    }
    if (length <= longest || away < kLeadsAway * length) continue;
    longest = length;
    best = foot.second;
  }
  return best;
}

}  // namespace wilt::detail
