#include "wilt/venation/photo_veins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/nearest_point.hpp"
#include "wilt/geodesics/trace.hpp"

namespace wilt {
namespace {

constexpr double kFloor = 0.06;         // strength of a texel without a ridge, for its cost
constexpr double kClear = 0.5;          // mean strength along a vein
constexpr double kOwnRoot = 0.08;       // a primary vein is on its own from here on, of the leaf's length
constexpr double kLeastPrimary = 0.35;  // its length at least, of the longest
constexpr double kTipWeight = 1.3;      // of a tip that the margin shows, over a tooth beside it
constexpr double kLeastSecondary = 0.06;
constexpr double kSameEnd = 0.08;  // ends nearer than this are of one vein
constexpr int kClaim = 3;          // texels beside a vein that belong to it
constexpr int kSmoothing = 4;      // texels to either side that a path is averaged over
constexpr int kPointSpacing = 6;   // texels

using Way = std::vector<int>;  // texels, from the petiole outwards

// The texels of the ridge map, the cheapest way to each from the petiole, and what veins have claimed.
class Grid {
 public:
  Grid(const RidgeMap& ridges, const Vec2& petiole)
      : ridges_(ridges),
        before_(ridges.strength.size(), -1),
        claimed_(ridges.strength.size(), 0),
        start_(inside_near(petiole)) {
    spread();
  }

  double strength(int texel) const { return std::max(0.0f, ridges_.strength[std::size_t(texel)]); }
  bool claimed(int texel) const { return claimed_[std::size_t(texel)] != 0; }
  Vec2 uv(int texel) const {
    return Vec2(texel % ridges_.size + 0.5, texel / ridges_.size + 0.5) / ridges_.size;
  }
  double step(int a, int b) const { return (uv(a) - uv(b)).norm(); }

  /// Empty where the blade has no way to.
  Way way_to(const Vec2& place) const {
    Way way;
    for (int texel = inside_near(place); texel >= 0; texel = before_[std::size_t(texel)])
      way.push_back(texel);
    std::reverse(way.begin(), way.end());
    if (way.empty() || way.front() != start_) return {};
    return way;
  }

  void claim(const Way& way, std::size_t from) {
    for (std::size_t i = from; i < way.size(); ++i) {
      for (int dy = -kClaim; dy <= kClaim; ++dy) {
        for (int dx = -kClaim; dx <= kClaim; ++dx) {
          const int x = way[i] % ridges_.size + dx, y = way[i] / ridges_.size + dy;
          if (x >= 0 && y >= 0 && x < ridges_.size && y < ridges_.size)
            claimed_[std::size_t(y * ridges_.size + x)] = 1;
        }
      }
    }
  }

 private:
  bool is_inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < ridges_.size && y < ridges_.size &&
           ridges_.strength[std::size_t(y * ridges_.size + x)] >= 0.0f;
  }

  // The texel of the blade that is nearest to a place; -1 when it is far from the blade.
  int inside_near(const Vec2& place) const {
    constexpr int kReach = 8;
    const int x = static_cast<int>(place.x() * ridges_.size), y = static_cast<int>(place.y() * ridges_.size);
    int best = -1, least = std::numeric_limits<int>::max();
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        if (!is_inside(x + dx, y + dy) || dx * dx + dy * dy >= least) continue;
        least = dx * dx + dy * dy;
        best = (y + dy) * ridges_.size + x + dx;
      }
    }
    return best;
  }

  // Dijkstra over the eight neighbours.
  void spread() {
    if (start_ < 0) return;
    using Entry = std::pair<double, int>;
    std::vector<double> cost(ridges_.strength.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost[std::size_t(start_)] = 0.0;
    queue.emplace(0.0, start_);
    while (!queue.empty()) {
      const auto [reached, texel] = queue.top();
      queue.pop();
      if (reached > cost[std::size_t(texel)]) continue;
      const int x = texel % ridges_.size, y = texel / ridges_.size;
      for (int k = 0; k < 9; ++k) {
        const int dx = k % 3 - 1, dy = k / 3 - 1;
        if (k == 4 || !is_inside(x + dx, y + dy)) continue;
        const int next = texel + dy * ridges_.size + dx;
        const double length = dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0;
        const double further = reached + length * 0.5 * (price(texel) + price(next));
        if (further >= cost[std::size_t(next)]) continue;
        cost[std::size_t(next)] = further;
        before_[std::size_t(next)] = texel;
        queue.emplace(further, next);
      }
    }
  }
  double price(int texel) const { return 1.0 / (kFloor + strength(texel)); }

  const RidgeMap& ridges_;
  std::vector<int> before_;  // the way back to the petiole; -1: none
  std::vector<char> claimed_;
  int start_;
};

// The part of a way that no vein has claimed, and how clear a ridge it follows.
struct Branch {
  std::size_t root = 0;    // the way's first texel of its own
  double rooted_at = 0.0;  // length of the way up to there, in units of the texture
  double length = 0.0;     // of its own part
  double clearness = 0.0;  // mean strength along it
  double worth = 0.0;      // integral of strength - kClear / 2 along it
};

Branch own_part(const Grid& grid, const Way& way, std::size_t end) {
  Branch branch;
  for (std::size_t i = 1; i < end; ++i) {
    if (!grid.claimed(way[i])) continue;
    branch.root = i;
  }
  for (std::size_t i = 1; i < end; ++i) {
    const double step = grid.step(way[i - 1], way[i]);
    if (i <= branch.root) {
      branch.rooted_at += step;
      continue;
    }
    branch.length += step;
    branch.clearness += step * grid.strength(way[i]);
  }
  branch.worth = branch.clearness - 0.5 * kClear * branch.length;
  branch.clearness /= std::max(branch.length, 1e-12);
  return branch;
}

// Where the ridge of a way's own part ends: beyond it strength is below kClear on the whole.
std::size_t ridge_end(const Grid& grid, const Way& way) {
  const std::size_t root = own_part(grid, way, way.size()).root;
  double sum = 0.0, most = 0.0;
  std::size_t end = root;
  for (std::size_t i = root + 1; i < way.size(); ++i) {
    sum += grid.step(way[i - 1], way[i]) * (grid.strength(way[i]) - kClear);
    if (sum > most) most = sum, end = i + 1;
  }
  return end;
}

class Tracer {
 public:
  Tracer(const Leaf& leaf, const Venation& found)
      : leaf_(leaf),
        found_(found),
        grid_(leaf.photo->ridges, uv_of(leaf.petiole)),
        plane_(leaf.skin.uv.rows(), 3) {
    plane_ << leaf.skin.uv, Eigen::VectorXd::Zero(plane_.rows());
    for (const Tip& tip : found.tips)
      longest_ = std::max(longest_, (uv_of(tip.vertex) - uv_of(leaf.petiole)).norm());
  }

  std::vector<DrawnVein> veins() {
    trace_primaries();
    if (veins_.empty()) return {};
    trace_secondaries();
    keep_what_is_not_shown();
    return std::move(veins_);
  }

 private:
  Vec2 uv_of(VertexId vertex) const {
    const auto at = std::find(leaf_.skin.vertex.begin(), leaf_.skin.vertex.end(), vertex);
    return leaf_.skin.uv.row(at - leaf_.skin.vertex.begin()).transpose();
  }

  // The clearest way first, until none is left that is on its own from the petiole.
  void trace_primaries() {
    PeakOptions small;
    small.window_length = 0.02;
    small.min_prominence = 0.004;
    struct Candidate {
      Way way;
      double weight;
      VertexId tip;
    };
    std::vector<Candidate> candidates;
    for (const Peak& peak : find_peaks(found_.margin, small)) {
      const VertexId vertex = found_.margin.vertices[std::size_t(peak.index)];
      const bool is_tip = std::any_of(found_.tips.begin(), found_.tips.end(),
                                      [vertex](const Tip& tip) { return tip.vertex == vertex; });
      Way way = grid_.way_to(uv_of(vertex));
      if (way.size() > 1) candidates.push_back({std::move(way), is_tip ? kTipWeight : 1.0, vertex});
    }
    while (true) {
      const Candidate* best = nullptr;
      double most = 0.0;
      for (const Candidate& candidate : candidates) {
        const Branch branch = own_part(grid_, candidate.way, candidate.way.size());
        const bool fits = branch.rooted_at <= kOwnRoot * longest_ && branch.clearness >= kClear &&
                          branch.length >= kLeastPrimary * longest_;
        if (!fits || candidate.weight * branch.worth <= most) continue;
        best = &candidate;
        most = candidate.weight * branch.worth;
      }
      if (best == nullptr) return;
      grid_.claim(best->way, 0);
      add_primary(best->way, best->tip);
    }
  }

  void trace_secondaries() {
    std::vector<Way> ways;
    for (const VertexId vertex : found_.margin.vertices) {
      Way way = grid_.way_to(uv_of(vertex));
      if (way.size() > 1) ways.push_back(std::move(way));
    }
    while (true) {
      const Way* best = nullptr;
      Branch best_branch;
      std::size_t best_end = 0;
      for (const Way& way : ways) {
        const std::size_t end = ridge_end(grid_, way);
        const Branch branch = own_part(grid_, way, end);
        if (branch.length >= kLeastSecondary * longest_ && branch.worth > best_branch.worth)
          best = &way, best_branch = branch, best_end = end;
      }
      if (best == nullptr) return;
      grid_.claim(Way(best->begin(), best->begin() + std::ptrdiff_t(best_end)), best_branch.root);
      DrawnVein vein{2, points_along(*best, best_branch.root, best_end)};
      if (follows(vein.points, 0)) veins_.push_back(std::move(vein));
    }
  }

  // A tip that no vein of the photo ends near keeps the vein that was found.
  void keep_what_is_not_shown() {
    const std::size_t shown = veins_.size();
    const bool no_secondaries =
        std::all_of(veins_.begin(), veins_.end(), [](const DrawnVein& vein) { return vein.order == 1; });
    for (std::size_t i = 0; i < found_.veins.size(); ++i) {
      DrawnVein vein{found_.veins[i].order, found_.veins[i].path.points, static_cast<int>(i)};
      const Vec3 end = place(vein.points.back());
      const bool is_shown =
          std::any_of(veins_.begin(), veins_.begin() + std::ptrdiff_t(shown), [&](const DrawnVein& other) {
            return (place(other.points.back()) - end).norm() < kSameEnd * length_;
          });
      if (vein.order == 1 ? !is_shown : no_secondaries) veins_.push_back(std::move(vein));
    }
  }

  Vec3 place(const SurfacePoint& point) const { return position(leaf_.mesh, leaf_.positions, point); }

  // The shortest way to the tip where the mesh does not let the vein through.
  void add_primary(const Way& way, VertexId tip) {
    DrawnVein vein{1, points_along(way, 0, way.size())};
    vein.points.back() = surface_point(leaf_.mesh, tip);
    if (!follows(vein.points, 1))
      vein.points = ExactGeodesics(leaf_.mesh, leaf_.positions).paths(leaf_.petiole, {tip})[0].points;
    veins_.push_back(std::move(vein));
  }

  // A stretch of a way as points of the surface, smoothed.
  std::vector<SurfacePoint> points_along(const Way& way, std::size_t begin, std::size_t end) const {
    std::vector<SurfacePoint> points;
    for (std::size_t i = begin; i < end; i += kPointSpacing) {
      const std::size_t reach = std::min({std::size_t(kSmoothing), i - begin, end - 1 - i});
      Vec2 mean = Vec2::Zero();
      for (std::size_t k = i - reach; k <= i + reach; ++k)
        mean += grid_.uv(way[k]) / (2.0 * double(reach) + 1.0);
      points.push_back(at(mean));
    }
    points.push_back(at(grid_.uv(way[end - 1])));
    return points;
  }

  // Leaves out points that cannot be reached straight ahead from those before: veins that border a sinus run
  // along the margin, which the mesh rounds off. False when that takes more than a third of them.
  // `from_petiole` is 1 when the way begins at the petiole.
  bool follows(std::vector<SurfacePoint>& points, int from_petiole) const {
    std::vector<SurfacePoint> way = points;
    if (from_petiole == 1) way.insert(way.begin(), surface_point(leaf_.mesh, leaf_.petiole));
    while (true) {
      const DrawnPath traced = trace_through(leaf_.mesh, leaf_.positions, way);
      if (traced.reached == static_cast<int>(way.size())) {
        points.assign(way.begin() + from_petiole, way.end());
        return points.size() > 1 && traced.path.points.size() > 1;
      }
      way.erase(way.begin() + traced.reached);
      if (3 * way.size() < 2 * points.size()) return false;
    }
  }

  SurfacePoint at(const Vec2& uv) const {
    SurfacePoint point = nearest_point(leaf_.skin.faces, plane_, Vec3(uv.x(), uv.y(), 0.0)).point;
    // Off the rim: between points on a concave rim the straight way leaves the blade.
    const auto corners = leaf_.mesh.face_vertices(point.face);
    const bool at_rim =
        std::any_of(corners.begin(), corners.end(), [this](VertexId v) { return leaf_.mesh.is_boundary(v); });
    if (at_rim) point.barycentric = 0.6 * point.barycentric + Vec3::Constant(0.4 / 3.0);
    return point;
  }

  const Leaf& leaf_;
  const Venation& found_;
  Grid grid_;
  Points3 plane_;
  double length_ = leaf_length(leaf_);
  double longest_ = 0.0;  // from the petiole to a tip, in units of the texture
  std::vector<DrawnVein> veins_;
};

}  // namespace

std::vector<DrawnVein> photo_veins(const Leaf& leaf, const Venation& found) {
  if (!leaf.photo || leaf.photo->ridges.size == 0) return {};
  return Tracer(leaf, found).veins();
}

}  // namespace wilt
