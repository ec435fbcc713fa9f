#include "wilt/import/scan_chart.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/embedding/embedding.hpp"
#include "wilt/import/point_index.hpp"
#include "wilt/import/scan_limits.hpp"
#include "wilt/import/scan_nodes.hpp"

namespace wilt::detail {
namespace {

constexpr int kLandmarks = 60;
constexpr int kRounds = 300;            // of majorisation
constexpr double kSmallMove = 1e-4;     // a round's largest move to stop at, in node spacings
constexpr double kSizeablePiece = 0.1;  // of the largest, to be mentioned

// Majorises sum over links of (|x_i - x_j| - l_ij)^2 / l_ij^2: each round solves L x = B(x) x, L the weighted
// Laplacian of the links, the first node held.
void relax_links(const ScanNodes& nodes, Points2& plane) {
  const int n = static_cast<int>(plane.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    for (const NodeLink& link : nodes.links[i]) {
      const double weight = 1.0 / (link.length * link.length);
      if (i > 0) entries.emplace_back(i - 1, i - 1, weight);
      if (i > 0 && link.node > 0) entries.emplace_back(i - 1, link.node - 1, -weight);
    }
  }
  Eigen::SparseMatrix<double> laplacian(n - 1, n - 1);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  plane.rowwise() -= plane.row(0).eval();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixX2d pull = Eigen::MatrixX2d::Zero(n, 2);
    for (int i = 0; i < n; ++i) {
      for (const NodeLink& link : nodes.links[i]) {
        const Eigen::RowVector2d arm = plane.row(i) - plane.row(link.node);
        pull.row(i) += arm / (link.length * std::max(arm.norm(), 1e-9 * link.length));
      }
    }
    Points2 next = Points2::Zero(n, 2);
    next.bottomRows(n - 1) = solver.solve(pull.bottomRows(n - 1));
    const double move = (next - plane).rowwise().norm().maxCoeff();
    plane = next;
    if (move <= kSmallMove * nodes.spacing) break;
  }
}

// The map from the tangent plane at a node to the layout: uv - uv_node = jacobian * (p - p_node).
struct NodeMap {
  Eigen::Matrix<double, 2, 3> jacobian;
  Vec3 normal;  // of the side from which it is not mirrored
};

NodeMap map_at(const ScanNodes& nodes, const Points2& plane, int i) {
  const Vec3 normal = nodes.normals.row(i).transpose();
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  Eigen::Matrix2d left = Eigen::Matrix2d::Identity() * (1e-9 * nodes.spacing * nodes.spacing);
  Eigen::Matrix2d right = Eigen::Matrix2d::Zero();
  for (const NodeLink& link : nodes.links[i]) {
    const Vec3 arm = (nodes.places.row(link.node) - nodes.places.row(i)).transpose();
    const Vec2 flat(arm.dot(x), arm.dot(y));
    left += flat * flat.transpose();
    right += (plane.row(link.node) - plane.row(i)).transpose() * flat.transpose();
  }
  const Eigen::Matrix2d turn = right * left.inverse();
  NodeMap map;
  map.jacobian = turn.col(0) * x.transpose() + turn.col(1) * y.transpose();
  map.normal = turn.determinant() >= 0.0 ? normal : Vec3(-normal);
  return map;
}

// The share of nodes with another near in the plane that is far in space.
double folded_share(const ScanNodes& nodes, const Points2& plane) {
  Points3 flat = Points3::Zero(plane.rows(), 3);
  flat.leftCols<2>() = plane;
  const PointIndex index(flat);
  int folded = 0;
  for (int i = 0; i < flat.rows(); ++i) {
    const std::vector<int> near = index.within(flat.row(i).transpose(), 0.8 * nodes.spacing);
    folded += std::any_of(near.begin(), near.end(), [&](int j) {
      return (nodes.places.row(i) - nodes.places.row(j)).norm() > 3.0 * nodes.spacing;
    });
  }
  return static_cast<double>(folded) / static_cast<double>(flat.rows());
}

// A point is carried by its node and the nodes linked to that, near ones more.
Vec2 place_point(const ScanNodes& nodes, const Points2& plane, const std::vector<NodeMap>& maps, int node,
                 const Vec3& point) {
  Vec2 sum = Vec2::Zero();
  double total = 0.0;
  const auto add = [&](int i) {
    const Vec3 arm = point - nodes.places.row(i).transpose();
    const double weight = std::exp(-arm.squaredNorm() / (nodes.spacing * nodes.spacing));
    sum += weight * (plane.row(i).transpose() + maps[i].jacobian * arm);
    total += weight;
  };
  add(node);
  for (const NodeLink& link : nodes.links[node]) add(link.node);
  return sum / total;
}

ScanNodes chosen_piece(const CleanScan& scan, int nth, std::vector<std::string>& notes) {
  const ScanNodes nodes = pick_nodes(scan);
  std::vector<std::vector<int>> pieces = pieces_of(nodes);
  const double least = kSizeablePiece * static_cast<double>(pieces.front().size());
  const auto sizeable = static_cast<int>(std::count_if(pieces.begin(), pieces.end(), [&](const auto& piece) {
    return static_cast<double>(piece.size()) >= least;
  }));
  if (nth > sizeable)
    throw Error(ErrorCode::input,
                fmt::format("there is no leaf {}: the scan has {} piece{} of at least a tenth of the largest",
                            nth, sizeable, sizeable == 1 ? "" : "s"));
  if (sizeable > 1)
    notes.push_back(fmt::format(
        "the scan falls into {} pieces; number {} by size was taken (--leaf N for another)", sizeable, nth));
  return only_piece(nodes, pieces[nth - 1]);
}

Points2 lay_out_nodes(const ScanNodes& nodes, const Monitor& monitor) {
  const int landmarks = std::min(kLandmarks, static_cast<int>(nodes.places.rows()));
  std::vector<int> chosen;
  const Eigen::MatrixXd distances = spread_distances(nodes, landmarks, chosen);
  Points2 plane = landmark_mds(distances, chosen, {}, monitor).coordinates;
  relax_links(nodes, plane);
  return plane;
}

}  // namespace

ScanChart lay_out(const CleanScan& scan, int nth, std::vector<std::string>& notes, const Monitor& monitor) {
  const ScanNodes nodes = chosen_piece(scan, nth, notes);
  if (nodes.places.rows() < 30)
    throw Error(
        ErrorCode::input,
        fmt::format("the points hang together in pieces of {} spots at most; a leaf's surface needs points "
                    "all over, about evenly spaced",
                    nodes.places.rows()));
  Points2 plane = lay_out_nodes(nodes, monitor);
  monitor.throw_if_cancelled();
  const double folded = folded_share(nodes, plane);
  if (folded > kMostFolded)
    throw Error(ErrorCode::input,
                fmt::format("{:.0f} % of the surface lies over itself when it is laid out flat ({:.0f} % are "
                            "allowed): it is closed, or several leaves that touch; cut out one leaf's blade",
                            100 * folded, 100 * kMostFolded));
  std::vector<NodeMap> maps;
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < plane.rows(); ++i) {
    maps.push_back(map_at(nodes, plane, i));
    normal += maps.back().normal;
  }
  normal /= static_cast<double>(plane.rows());
  const double turn = normal.z() < 0.0 ? -1.0 : 1.0;
  ScanChart chart;
  chart.normal = turn * normal;
  std::vector<Vec2> uv;
  for (int i = 0; i < scan.points.rows(); ++i) {
    const int node = nodes.of_point[i];
    if (node < 0) continue;
    chart.points.push_back(i);
    uv.push_back(place_point(nodes, plane, maps, node, scan.smooth.row(i).transpose()));
  }
  chart.uv.resize(static_cast<Eigen::Index>(uv.size()), 2);
  for (std::size_t i = 0; i < uv.size(); ++i) chart.uv.row(i) << uv[i].x(), turn * uv[i].y();
  return chart;
}

}  // namespace wilt::detail
