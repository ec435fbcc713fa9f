#include "wilt/import/scan_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "wilt/import/point_index.hpp"

namespace wilt::detail {
namespace {

constexpr double kApart = 1.6;         // nodes, in spacings of the points
constexpr double kMostNodes = 2500.0;  // about
constexpr double kLinkReach = 2.5;     // in spacings of the nodes
constexpr double kAcross = 0.6;        // the sine above which a link leaves the surface

// Takes points in order, each unless one that was taken is too near.
std::vector<int> spread_points(const Points3& points, double apart) {
  const PointIndex index(points);
  std::vector<char> covered(static_cast<std::size_t>(points.rows()), 0);
  std::vector<int> taken;
  for (int i = 0; i < points.rows(); ++i) {
    if (covered[i]) continue;
    taken.push_back(i);
    for (const int j : index.within(points.row(i).transpose(), apart)) covered[j] = 1;
  }
  return taken;
}

Points3 rows_of(const Points3& all, const std::vector<int>& rows) {
  Points3 some(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(i) = all.row(rows[i]);
  return some;
}

void link(ScanNodes& nodes, const PointIndex& index) {
  nodes.links.resize(static_cast<std::size_t>(nodes.places.rows()));
  for (int i = 0; i < nodes.places.rows(); ++i) {
    const Vec3 at = nodes.places.row(i).transpose();
    for (const int j : index.within(at, kLinkReach * nodes.spacing)) {
      const Vec3 arm = nodes.places.row(j).transpose() - at;
      const double length = arm.norm();
      if (j == i || length == 0.0) continue;
      const double across =
          std::max(std::abs(nodes.normals.row(i).dot(arm)), std::abs(nodes.normals.row(j).dot(arm)));
      if (across <= kAcross * length) nodes.links[i].push_back({j, length});
    }
  }
}

Eigen::VectorXd path_lengths(const ScanNodes& nodes, int from) {
  Eigen::VectorXd length =
      Eigen::VectorXd::Constant(nodes.places.rows(), std::numeric_limits<double>::infinity());
  using Visit = std::pair<double, int>;
  std::priority_queue<Visit, std::vector<Visit>, std::greater<>> queue;
  length[from] = 0.0;
  queue.push({0.0, from});
  while (!queue.empty()) {
    const auto [reached, node] = queue.top();
    queue.pop();
    if (reached > length[node]) continue;
    for (const NodeLink& next : nodes.links[node]) {
      if (reached + next.length >= length[next.node]) continue;
      length[next.node] = reached + next.length;
      queue.push({length[next.node], next.node});
    }
  }
  return length;
}

}  // namespace

ScanNodes pick_nodes(const CleanScan& scan) {
  ScanNodes nodes;
  const double area = scan.spacing * scan.spacing * static_cast<double>(scan.points.rows());
  nodes.spacing = std::max(kApart * scan.spacing, std::sqrt(area / kMostNodes));
  const std::vector<int> taken = spread_points(scan.smooth, nodes.spacing);
  nodes.places = rows_of(scan.smooth, taken);
  nodes.normals = rows_of(scan.normals, taken);
  const PointIndex index(nodes.places);
  link(nodes, index);
  for (int i = 0; i < scan.smooth.rows(); ++i)
    nodes.of_point.push_back(index.nearest(scan.smooth.row(i).transpose(), 1).front());
  return nodes;
}

std::vector<std::vector<int>> pieces_of(const ScanNodes& nodes) {
  std::vector<std::vector<int>> pieces;
  std::vector<char> seen(nodes.links.size(), 0);
  for (int start = 0; start < nodes.places.rows(); ++start) {
    if (seen[start]) continue;
    std::vector<int> piece{start};
    seen[start] = 1;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      for (const NodeLink& next : nodes.links[piece[k]]) {
        if (std::exchange(seen[next.node], 1) == 0) piece.push_back(next.node);
      }
    }
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return pieces;
}

ScanNodes only_piece(const ScanNodes& nodes, const std::vector<int>& piece) {
  std::vector<int> renamed(nodes.links.size(), -1);
  for (std::size_t i = 0; i < piece.size(); ++i) renamed[piece[i]] = static_cast<int>(i);
  ScanNodes part;
  part.spacing = nodes.spacing;
  part.places = rows_of(nodes.places, piece);
  part.normals = rows_of(nodes.normals, piece);
  for (const int i : piece) {
    part.links.push_back(nodes.links[i]);
    for (NodeLink& next : part.links.back()) next.node = renamed[next.node];
  }
  for (const int node : nodes.of_point) part.of_point.push_back(renamed[node]);
  return part;
}

Eigen::MatrixXd spread_distances(const ScanNodes& nodes, int count, std::vector<int>& chosen) {
  Eigen::MatrixXd distances(nodes.places.rows(), count);
  int next = 0;
  path_lengths(nodes, 0).maxCoeff(&next);
  Eigen::VectorXd nearest;
  for (int k = 0; k < count; ++k) {
    chosen.push_back(next);
    distances.col(k) = path_lengths(nodes, next);
    nearest = k == 0 ? distances.col(0).eval() : nearest.cwiseMin(distances.col(k)).eval();
    nearest.maxCoeff(&next);
  }
  return distances;
}

}  // namespace wilt::detail
