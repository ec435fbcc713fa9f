#include "wilt/leaf/necks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wilt::detail {
namespace {

struct Place {
  std::size_t ring, index;
};

// Segments by the cells of a grid that they come near to.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<Polyline>& rings, double cell) : cell_(cell) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t i = 0; i < rings[r].size(); ++i) {
        const Vec2& a = rings[r][i];
        const Vec2& b = rings[r][(i + 1) % rings[r].size()];
        for (std::int64_t y = of(std::min(a.y(), b.y())) - 1; y <= of(std::max(a.y(), b.y())) + 1; ++y) {
          for (std::int64_t x = of(std::min(a.x(), b.x())) - 1; x <= of(std::max(a.x(), b.x())) + 1; ++x) {
            entries_.emplace_back(key(x, y), Place{r, i});
          }
        }
      }
    }
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  template <class Visit>
  void near(const Vec2& p, Visit&& visit) const {
    const std::int64_t wanted = key(of(p.x()), of(p.y()));
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), wanted,
                                  [](const auto& e, std::int64_t k) { return e.first < k; });
    for (; entry != entries_.end() && entry->first == wanted; ++entry) visit(entry->second);
  }

 private:
  std::int64_t of(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }
  static std::int64_t key(std::int64_t x, std::int64_t y) { return x * (std::int64_t{1} << 32) + y; }

  double cell_;
  std::vector<std::pair<std::int64_t, Place>> entries_;
};

// The thickness of the blade at a margin point, measured into it; at most `width`.
double thickness_at(const std::vector<Polyline>& rings, const SegmentGrid& grid, const Place& at,
                    const Vec2& inwards, double width) {
  const Vec2& p = rings[at.ring][at.index];
  double thickness = width;
  grid.near(p, [&](const Place& other) {
    const Polyline& ring = rings[other.ring];
    const std::size_t end = (other.index + 1) % ring.size();
    if (other.ring == at.ring && (other.index == at.index || end == at.index)) return;
    const Vec2& a = ring[other.index];
    const Vec2 u = ring[end] - a;
    if (u.squaredNorm() == 0.0) return;
    const double t = std::clamp((p - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
    const Vec2 d = a + t * u - p;
    // The far side of the blade runs against this side and lies straight across.
    const bool across = d.dot(inwards) > 0.7 * d.norm() && cross(u, inwards) < 0.0;
    if (across) thickness = std::min(thickness, d.norm());
  });
  return thickness;
}

}  // namespace

void thicken_necks(std::vector<Polyline>& rings, double width) {
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    const SegmentGrid grid(rings, width);
    std::vector<Polyline> moved = rings;
    bool any = false;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const std::size_t n = rings[r].size();
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 along = rings[r][(i + 1) % n] - rings[r][(i + n - 1) % n];
        if (along.squaredNorm() == 0.0) continue;
        const Vec2 inwards = Vec2(-along.y(), along.x()).normalized();
        const double thickness = thickness_at(rings, grid, {r, i}, inwards, width);
        if (thickness >= 0.99 * width) continue;
        moved[r][i] -= 0.5 * (width - thickness) * inwards;
        any = true;
      }
    }
    if (!any) return;
    rings = std::move(moved);
  }
}

}  // namespace wilt::detail
