#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "wilt/geodesics/trace.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {
namespace {

[[noreturn]] void refuse(std::size_t index, const std::string& reason) {
  throw Error(ErrorCode::input, fmt::format("veins[{}]: {}", index, reason));
}

class Drawing {
 public:
  Drawing(const Leaf& leaf, const Venation& found) : leaf_(leaf), found_(found) {}

  SurfacePath path(const DrawnVein& drawn, std::size_t index) const {
    if (drawn.found >= 0) return found_.veins[static_cast<std::size_t>(drawn.found)].path;
    std::vector<SurfacePoint> points = drawn.points;
    if (drawn.order == 1) {
      const Vec3 petiole = leaf_.positions.row(leaf_.petiole).transpose();
      if ((at(points.back()) - petiole).norm() < (at(points.front()) - petiole).norm())
        std::reverse(points.begin(), points.end());
      points.insert(points.begin(), surface_point(leaf_.mesh, leaf_.petiole));
    }
    DrawnPath traced = trace_through(leaf_.mesh, leaf_.positions, points);
    if (traced.reached < static_cast<int>(points.size()))
      refuse(index,
             fmt::format("the way to its point {} leaves the blade; draw it within the blade, with more "
                         "points around holes and sinuses",
                         traced.reached - (drawn.order == 1 ? 1 : 0)));
    if (traced.path.points.size() < 2) refuse(index, "it has no length; draw two different points or more");
    return std::move(traced.path);
  }

  /// The place on the margin profile of the vertex nearest to a path's end.
  int margin_index(const SurfacePath& path) const {
    const Eigen::RowVector3d end = at(path.points.back()).transpose();
    const auto& margin = found_.margin.vertices;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < margin.size(); ++i) {
      const double square = (leaf_.positions.row(margin[i]) - end).squaredNorm();
      if (square < least) best = i, least = square;
    }
    return static_cast<int>(best);
  }

  /// A tip that was found keeps its prominence; a drawn one has none.
  Tip tip(int margin_index) const {
    const VertexId vertex = found_.margin.vertices[static_cast<std::size_t>(margin_index)];
    const auto same = std::find_if(found_.tips.begin(), found_.tips.end(),
                                   [vertex](const Tip& tip) { return tip.vertex == vertex; });
    if (same != found_.tips.end()) return *same;
    return {vertex, found_.margin.s(margin_index), found_.margin.d(margin_index), 0.0};
  }

  /// The vein with the point nearest to where `path` begins.
  int parent(const SurfacePath& path, const std::vector<SurfacePath>& primaries) const {
    const Vec3 base = at(path.points.front());
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < primaries.size(); ++i) {
      for (const SurfacePoint& point : primaries[i].points) {
        const double square = (at(point) - base).squaredNorm();
        if (square < least) best = static_cast<int>(i), least = square;
      }
    }
    return best;
  }

 private:
  Vec3 at(const SurfacePoint& point) const { return position(leaf_.mesh, leaf_.positions, point); }

  const Leaf& leaf_;
  const Venation& found_;
};

/// A primary vein with where it ends.
struct Primary {
  std::size_t index;  // among the drawn veins
  int end;            // on the margin profile
  SurfacePath path;
};

bool unchanged(const std::vector<DrawnVein>& drawn, const Venation& found) {
  if (drawn.size() != found.veins.size()) return false;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].found != static_cast<int>(i)) return false;
  }
  return true;
}

std::vector<Primary> primaries_by_margin(const Drawing& drawing, const std::vector<DrawnVein>& drawn) {
  std::vector<Primary> primaries;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].order != 1 && drawn[i].order != 2)
      refuse(i, fmt::format("its order is {}; it must be 1 (primary) or 2 (secondary)", drawn[i].order));
    if (drawn[i].order == 2) continue;
    SurfacePath path = drawing.path(drawn[i], i);
    const int end = drawing.margin_index(path);
    primaries.push_back({i, end, std::move(path)});
  }
  if (primaries.empty())
    throw Error(ErrorCode::input, "there is no vein of order 1; draw at least one from the petiole to a tip");
  std::stable_sort(primaries.begin(), primaries.end(),
                   [](const Primary& a, const Primary& b) { return a.end < b.end; });
  for (std::size_t i = 1; i < primaries.size(); ++i) {
    if (primaries[i].end == primaries[i - 1].end)
      refuse(primaries[i].index,
             fmt::format("it ends at the same tip as veins[{}]; delete one of them", primaries[i - 1].index));
  }
  return primaries;
}

void measure(const Leaf& leaf, const std::vector<SurfacePath>& primary,
             const std::vector<SurfacePath>& secondary, const VenationOptions& options, Venation& veins) {
  const FastGeodesics fast(leaf.mesh, leaf.positions);
  veins.primary_distance = fast.distances(primary);
  veins.vein_distance = veins.primary_distance;
  if (!secondary.empty()) veins.vein_distance = veins.vein_distance.cwiseMin(fast.distances(secondary));
  std::vector<VertexId> tips;
  for (const Tip& tip : veins.tips) tips.push_back(tip.vertex);
  veins.tip_distance = geodesic_distances(leaf.mesh, leaf.positions, tips, options.geodesics).transpose();
}

}  // namespace

Venation with_drawn_veins(const Leaf& leaf, const Venation& found, const std::vector<DrawnVein>& drawn,
                          const VenationOptions& options) {
  if (unchanged(drawn, found)) return found;
  const Drawing drawing(leaf, found);
  Venation result = found;
  result.tips.clear();
  result.veins.clear();
  std::vector<SurfacePath> primary, secondary;
  for (const Primary& vein : primaries_by_margin(drawing, drawn)) {
    result.veins.push_back({1, static_cast<int>(result.tips.size()), -1, vein.path});
    result.tips.push_back(drawing.tip(vein.end));
    primary.push_back(vein.path);
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].order == 1) continue;
    secondary.push_back(drawing.path(drawn[i], i));
    result.veins.push_back({2, -1, drawing.parent(secondary.back(), primary), secondary.back()});
  }
  measure(leaf, primary, secondary, options, result);
  return result;
}

}  // namespace wilt
