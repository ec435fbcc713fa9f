#include "wilt/venation/venation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/venation/flatten.hpp"
#include "wilt/venation/photo_veins.hpp"
#include "wilt/venation/secondary.hpp"

namespace wilt {
namespace {

// Exact paths are first sought where a detour is no longer than this, in mean edge lengths.
constexpr double kDetour = 0.15;
constexpr double kWider = 4.0;

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

/// The exact shortest path from the petiole to a tip, sought in a band of vertices through which the way is
/// longer than the shortest by a detour at most, by the fast distances from both. A path that leaves the band
/// is longer than that but for two errors of the fast distances; so one that is longer by half the detour at
/// most is the shortest of all if these errors are below a quarter of the detour. Else the band is widened.
SurfacePath primary_path(const ExactGeodesics& exact, VertexId petiole, VertexId tip, double edge,
                         const Eigen::Ref<const Eigen::VectorXd>& from_petiole,
                         const Eigen::Ref<const Eigen::VectorXd>& from_tip) {
  const double fast = from_petiole(int(tip));
  for (double detour = kDetour * edge; detour < fast; detour *= kWider) {
    std::vector<char> within(from_tip.size());
    for (std::size_t v = 0; v < within.size(); ++v)
      within[v] = from_petiole(v) + from_tip(v) <= fast + detour ? 1 : 0;
    SurfacePath path = std::move(exact.paths(petiole, {tip}, within)[0]);
    if (!path.points.empty() && path.length <= fast + 0.5 * detour) return path;
  }
  return std::move(exact.paths(petiole, {tip})[0]);
}

/// `ends`: the fast distances from the petiole (column 0) and from the tips.
std::vector<Vein> primary_veins(const Leaf& leaf, const std::vector<Tip>& tips, const Eigen::MatrixXd& ends) {
  const ExactGeodesics exact(leaf.mesh, leaf.positions);
  const double edge = mean_edge_length(leaf.mesh, leaf.positions);
  std::vector<Vein> veins(tips.size());
  parallel_for(static_cast<int>(tips.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      veins[i].tip = i;
      veins[i].path = primary_path(exact, leaf.petiole, tips[i].vertex, edge, ends.col(0), ends.col(i + 1));
    }
  });
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

// Distances from every tip to every vertex are kept three times over.
void check_count(std::size_t tips, int vertices) {
  constexpr double kMostDistances = 4e8;  // 10 GB
  if (static_cast<double>(tips) * vertices > kMostDistances)
    throw Error(
        ErrorCode::input,
        fmt::format("{} vein tips on {} vertices are more than memory is taken for: a rough margin has "
                    "too many peaks; give fewer --vertices (5000 shows every lobe), or raise "
                    "veins.min_prominence",
                    tips, vertices));
}

// The veins that the photo shows in place of those found, if it shows any.
void use_photo(const Leaf& leaf, const VenationOptions& options, Venation& result) {
  std::vector<DrawnVein> shown = photo_veins(leaf, result);
  if (!options.secondary)
    shown.erase(
        std::remove_if(shown.begin(), shown.end(), [](const DrawnVein& vein) { return vein.order == 2; }),
        shown.end());
  if (shown.empty()) return;
  result = with_drawn_veins(leaf, result, shown, options);
  result.from_photo = true;
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
  const auto start = std::chrono::steady_clock::now();
  const FastGeodesics fast(leaf.mesh, leaf.positions);
  detail::Flattened flattened = detail::flatten(leaf, fast, options, monitor);
  const auto begin = std::chrono::steady_clock::now();
  result.flat = std::move(flattened.coordinates);
  result.embedding_stress = flattened.stress;
  result.margin = expand_margin(margin_loop(leaf.mesh, leaf.positions), result.flat, leaf.petiole);
  result.tips = find_tips(result.margin, options.peaks);
  monitor.report("venation", 0.1);

  check_count(result.tips.size(), leaf.mesh.num_vertices());
  const int vertices = leaf.mesh.num_vertices(), tips = static_cast<int>(result.tips.size());
  std::vector<VertexId> end_vertices{leaf.petiole};
  for (const Tip& tip : result.tips) end_vertices.push_back(tip.vertex);
  const Eigen::MatrixXd ends = fast.distances(end_vertices);
  result.veins = primary_veins(leaf, result.tips, ends);
  result.tip_distance = ends.rightCols(tips).transpose();
  if (options.geodesics == GeodesicMethod::exact)
    result.tip_distance = geodesic_distances(leaf.mesh, leaf.positions, std::span(end_vertices).subspan(1),
                                             GeodesicMethod::exact)
                              .transpose();
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
  if (options.from_photo) use_photo(leaf, options, result);
  monitor.report("venation", 1.0);
  const std::chrono::duration<double> before = begin - start,
                                      spent = std::chrono::steady_clock::now() - begin;
  result.timings = {before.count() - flattened.embedding_seconds, flattened.embedding_seconds, spent.count()};
  return result;
}

}  // namespace wilt
