#include "wilt/reproduce/measures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "wilt/core/check.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/regions.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kTipReach = 0.12;   // of L, as in the metric of curl
constexpr double kLobeReach = 0.30;  // of L

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k) result[order[k]] = 0.5 * static_cast<double>(begin + end - 1);
    begin = end;
  }
  return result;
}

// How far the curve falls from `peak` in steps of +1 or -1 before it rises higher.
double fall(const std::vector<double>& curve, int peak, int step) {
  double lowest = curve[peak];
  for (int i = peak + step; i >= 0 && i < static_cast<int>(curve.size()); i += step) {
    if (curve[i] > curve[peak]) break;
    lowest = std::min(lowest, curve[i]);
  }
  return curve[peak] - lowest;
}

std::vector<VertexId> vertices_between(const Leaf& leaf, const Eigen::VectorXd& distance, double from,
                                       double to) {
  const double length = leaf_length(leaf);
  std::vector<VertexId> found;
  for (const VertexId v : leaf.mesh.vertices()) {
    if (distance[v] >= from * length && distance[v] <= to * length) found.push_back(v);
  }
  return found;
}

Vec3 mean_normal(const Points3& normals, const std::vector<VertexId>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : vertices) sum += normals.row(v).transpose();
  return sum.normalized();
}

}  // namespace

FinalMetrics final_metrics(const Experiment& experiment) {
  const FrameMetrics& m = experiment.result.metrics.back();
  FinalMetrics final{m.wrinkle, m.curl * kDegrees, m.area_ratio, m.max_strain, m.self_intersections};
  if (!experiment.result.completed)
    final.wrinkle = final.curl = final.area_ratio = final.max_strain =
        std::numeric_limits<double>::quiet_NaN();
  return final;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  WILT_CHECK(a.size() == b.size(), a.size(), b.size());
  const auto finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  if (!finite(a) || !finite(b)) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> ra = ranks(a), rb = ranks(b);
  const double mean = 0.5 * (static_cast<double>(a.size()) - 1.0);
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (ra[i] - mean) * (rb[i] - mean);
    aa += (ra[i] - mean) * (ra[i] - mean);
    bb += (rb[i] - mean) * (rb[i] - mean);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

Eigen::VectorXd first_mass(const Subject& subject, const Config& config) {
  const double scale = kWorkingLength / leaf_length(subject.leaf);
  const auto model =
      make_model({subject.leaf, subject.venation, config, scale, scale * subject.leaf.positions});
  const Eigen::VectorXd mass = model->water() + model->dry_mass();
  return mass * (config.mass.max / mass.maxCoeff());
}

Points3 in_petiole_frame(const Subject& subject, const Frame& frame) {
  const Leaf& leaf = subject.leaf;
  std::vector<VertexId> ring = leaf.mesh.one_ring(leaf.petiole);
  ring.push_back(leaf.petiole);
  const Eigen::Matrix3d turn = best_rotation(leaf.positions, frame.positions, ring);
  const Points3 arms = (frame.positions.rowwise() - frame.positions.row(leaf.petiole)) * turn;
  return (arms.rowwise() + leaf.positions.row(leaf.petiole)) / leaf_length(leaf);
}

Eigen::VectorXd displacement(const Subject& subject, const Frame& frame) {
  return (in_petiole_frame(subject, frame) - subject.leaf.positions / leaf_length(subject.leaf))
      .rowwise()
      .norm();
}

double area_share(const Subject& subject, const std::function<bool(VertexId)>& chosen) {
  const VertexData<double> areas = vertex_areas(subject.leaf.mesh, subject.leaf.positions);
  double all = 0.0, some = 0.0;
  for (const VertexId v : subject.leaf.mesh.vertices()) {
    all += areas[v];
    if (chosen(v)) some += areas[v];
  }
  return some / all;
}

double region_mean(const Subject& subject, const Eigen::VectorXd& values, Region region) {
  const VertexData<Region> regions = leaf_regions(subject.leaf, subject.venation);
  double sum = 0.0;
  int count = 0;
  for (const VertexId v : subject.leaf.mesh.vertices()) {
    if (regions[v] != region) continue;
    sum += values[v];
    ++count;
  }
  return sum / count;
}

double tip_rotation_in_lobe(const Subject& subject, const Frame& frame) {
  const Leaf& leaf = subject.leaf;
  const Points3 rest = vertex_normals(leaf.mesh, leaf.positions);
  const Points3 now = vertex_normals(leaf.mesh, frame.positions);
  const Eigen::MatrixXd& distance = subject.venation.tip_distance;
  double sum = 0.0;
  for (int r = 0; r < distance.rows(); ++r) {
    const auto tip = vertices_between(leaf, distance.row(r), 0.0, kTipReach);
    const auto behind = vertices_between(leaf, distance.row(r), kTipReach, kLobeReach);
    const Vec3 expected = best_rotation(leaf.positions, frame.positions, behind) * mean_normal(rest, tip);
    const Vec3 found = mean_normal(now, tip);
    sum += std::atan2(expected.cross(found).norm(), expected.dot(found));
  }
  return kDegrees * sum / static_cast<double>(distance.rows());
}

std::vector<double> force_curve(const Experiment& experiment, Region region, double ForceRow::*force) {
  std::vector<double> curve;
  for (const ForceRow& row : experiment.result.forces) {
    if (row.region == region) curve.push_back(row.*force);
  }
  return curve;
}

int count_waves(const std::vector<double>& curve, double share) {
  if (curve.empty()) return 0;
  const auto [least, most] = std::minmax_element(curve.begin(), curve.end());
  const double enough = share * (*most - *least);
  int waves = 0;
  for (int i = 1; i + 1 < static_cast<int>(curve.size()); ++i) {
    const bool peak = curve[i] > curve[i - 1] && curve[i] >= curve[i + 1];
    if (peak && fall(curve, i, -1) >= enough && fall(curve, i, +1) >= enough) ++waves;
  }
  return waves;
}

}  // namespace wilt
