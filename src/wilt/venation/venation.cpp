#include "wilt/venation/venation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/venation/flatten.hpp"
#include "wilt/venation/secondary.hpp"

namespace wilt {
namespace {

void require(bool holds, const char* key, double value, const char* allowed) {
  if (!holds)
    throw Error(ErrorCode::configuration, fmt::format("{} = {}; it must be {}", key, value, allowed));
}

void validate(const SecondaryVeinRule& rule) {
  const auto is_angle = [](double angle) { return angle > 0.0 && angle < 3.0; };
  require(is_angle(rule.angle), "secondary.angle", rule.angle, "in 0 to 3 radians");
  require(is_angle(rule.angle_tip), "secondary.angle_tip", rule.angle_tip, "in 0 to 3 radians");
  require(rule.spacing >= 0.02 && rule.spacing <= 10.0, "secondary.spacing", rule.spacing, "in 0.02 to 10");
  // Bent by more than its angle a vein would turn back to its primary.
  require(std::abs(rule.curvature) <= std::min(rule.angle, rule.angle_tip), "secondary.curvature",
          rule.curvature, "no larger than secondary.angle and secondary.angle_tip");
}

std::vector<Tip> find_tips(const MarginProfile& margin, const PeakOptions& options) {
  std::vector<Tip> tips;
  for (const Peak& peak : find_peaks(margin, options))
    tips.push_back(
        {margin.vertices[peak.index], margin.s(peak.index), margin.d(peak.index), peak.prominence});
  if (tips.empty())
    throw Error(ErrorCode::input,
                fmt::format("no tip found on a margin of {} vertices; check the petiole, use the peak rule "
                            "'prominence' or a smaller window",
                            margin.vertices.size()));
  return tips;
}

std::vector<Vein> primary_veins(const ExactGeodesics& geodesics, VertexId petiole,
                                const std::vector<Tip>& tips) {
  std::vector<VertexId> targets;
  for (const Tip& tip : tips) targets.push_back(tip.vertex);
  std::vector<SurfacePath> paths = geodesics.paths(petiole, targets);
  std::vector<Vein> veins;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    Vein& vein = veins.emplace_back();
    vein.tip = static_cast<int>(i);
    vein.path = std::move(paths[i]);
  }
  return veins;
}

/// Row i is row_of(i); in parallel.
template <class RowOf>
Eigen::MatrixXd rows(int count, int columns, const RowOf& row_of) {
  Eigen::MatrixXd matrix(count, columns);
  parallel_for(count, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) matrix.row(i) = row_of(i).transpose();
  });
  return matrix;
}

}  // namespace

void VenationOptions::validate() const {
  peaks.validate();
  require(full_embedding_up_to >= 0, "full_embedding_up_to", full_embedding_up_to, "at least 0");
  require(landmarks >= 4, "landmarks", landmarks, "at least 4");
}

Venation find_venation(const Leaf& leaf, const SecondaryVeinRule& rule, const VenationOptions& options,
                       const Monitor& monitor) {
  options.validate();
  validate(rule);
  Venation result;
  detail::Flattened flattened = detail::flatten(leaf, options, monitor);
  const auto begin = std::chrono::steady_clock::now();
  result.flat = std::move(flattened.coordinates);
  result.embedding_stress = flattened.stress;
  result.margin = expand_margin(margin_loop(leaf.mesh, leaf.positions), result.flat, leaf.petiole);
  result.tips = find_tips(result.margin, options.peaks);
  monitor.report("venation", 0.1);

  const int vertices = leaf.mesh.num_vertices(), tips = static_cast<int>(result.tips.size());
  const ExactGeodesics exact(leaf.mesh, leaf.positions);
  const FastGeodesics fast(leaf.mesh, leaf.positions);
  result.veins = primary_veins(exact, leaf.petiole, result.tips);
  result.tip_distance = rows(tips, vertices, [&](int i) { return exact.distances(result.tips[i].vertex); });
  monitor.throw_if_cancelled();
  monitor.report("venation", 0.6);

  const Eigen::MatrixXd to_primary = rows(tips, vertices, [&](int i) {
    return fast.distances(std::span<const SurfacePath>(&result.veins[i].path, 1));
  });
  result.primary_distance = to_primary.colwise().minCoeff().transpose();
  result.vein_distance = result.primary_distance;
  if (options.secondary) {
    std::vector<SurfacePath> paths;
    for (Vein& vein : detail::secondary_veins(leaf.mesh, leaf.positions, result.veins, to_primary, rule)) {
      paths.push_back(vein.path);
      result.veins.push_back(std::move(vein));
    }
    if (!paths.empty()) result.vein_distance = result.vein_distance.cwiseMin(fast.distances(paths));
  }
  monitor.report("venation", 1.0);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  result.timings = {flattened.geodesics_seconds, flattened.embedding_seconds, spent.count()};
  return result;
}

}  // namespace wilt
