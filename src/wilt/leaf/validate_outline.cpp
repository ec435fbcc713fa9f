#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "wilt/core/error.hpp"
#include "wilt/leaf/curves.hpp"
#include "wilt/leaf/outline.hpp"
#include "wilt/leaf/rings.hpp"

namespace wilt {
namespace detail {
namespace {

struct Segment {
  Vec2 a, b;
  int ring, index;       // from point `index` of the ring to the one after it
  int order, ring_size;  // its place among the ring's segments, and how many they are
};

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

bool within_box(const Segment& s, const Vec2& p) {
  return p.x() >= std::min(s.a.x(), s.b.x()) && p.x() <= std::max(s.a.x(), s.b.x()) &&
         p.y() >= std::min(s.a.y(), s.b.y()) && p.y() <= std::max(s.a.y(), s.b.y());
}

// Whether two segments have a point in common.
bool meet(const Segment& s, const Segment& t) {
  const double d1 = turn(s.a, s.b, t.a);
  const double d2 = turn(s.a, s.b, t.b);
  const double d3 = turn(t.a, t.b, s.a);
  const double d4 = turn(t.a, t.b, s.b);
  if (((d1 > 0 && d2 < 0) || (d1 < 0 && d2 > 0)) && ((d3 > 0 && d4 < 0) || (d3 < 0 && d4 > 0))) return true;
  return (d1 == 0 && within_box(s, t.a)) || (d2 == 0 && within_box(s, t.b)) ||
         (d3 == 0 && within_box(t, s.a)) || (d4 == 0 && within_box(t, s.b));
}

// Whether two segments that share the point `s.b == t.a` run over each other.
bool fold_back(const Segment& s, const Segment& t) {
  const Vec2 u = s.b - s.a;
  const Vec2 v = t.b - t.a;
  return cross(u, v) == 0.0 && u.dot(v) < 0.0;
}

bool follows(const Segment& s, const Segment& t) {
  return s.ring == t.ring && t.order == (s.order + 1) % s.ring_size;
}

bool conflict(const Segment& s, const Segment& t) {
  if (follows(s, t)) return fold_back(s, t);
  if (follows(t, s)) return fold_back(t, s);
  return meet(s, t);
}

std::vector<Segment> collect_segments(const std::vector<Polyline>& rings) {
  std::vector<Segment> segments;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t first = segments.size();
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vec2& a = rings[r][i];
      const Vec2& b = rings[r][(i + 1) % rings[r].size()];
      if (a == b) continue;
      segments.push_back(
          {a, b, static_cast<int>(r), static_cast<int>(i), static_cast<int>(segments.size() - first), 0});
    }
    for (std::size_t i = first; i < segments.size(); ++i)
      segments[i].ring_size = static_cast<int>(segments.size() - first);
  }
  return segments;
}

}  // namespace

std::optional<Crossing> find_crossing(const std::vector<Polyline>& rings) {
  const std::vector<Segment> segments = collect_segments(rings);
  if (segments.empty()) return std::nullopt;
  // Segments are entered in the cells of a grid about twice as wide as the mean segment: O(n) entries in all.
  Vec2 low = segments[0].a;
  Vec2 high = low;
  double total = 0.0;
  for (const Segment& s : segments) {
    low = low.cwiseMin(s.a);
    high = high.cwiseMax(s.a);
    total += (s.b - s.a).norm();
  }
  const double cell =
      std::max(2.0 * total / static_cast<double>(segments.size()), (high - low).norm() * 1e-5);
  const auto column_of = [&](double x) {
    return static_cast<std::int64_t>(std::floor((x - low.x()) / cell));
  };
  const auto row_of = [&](double y) { return static_cast<std::int64_t>(std::floor((y - low.y()) / cell)); };
  std::vector<std::pair<std::int64_t, std::size_t>> entries;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Vec2& l = segments[i].a.x() <= segments[i].b.x() ? segments[i].a : segments[i].b;
    const Vec2& r = segments[i].a.x() <= segments[i].b.x() ? segments[i].b : segments[i].a;
    for (std::int64_t column = column_of(l.x()); column <= column_of(r.x()); ++column) {
      // The segment's part within the column, widened by a little against rounding.
      const auto y_at = [&](double x) {
        const double t = r.x() > l.x() ? std::clamp((x - l.x()) / (r.x() - l.x()), 0.0, 1.0) : 0.0;
        return l.y() + t * (r.y() - l.y());
      };
      const double x0 = low.x() + static_cast<double>(column) * cell;
      double y0 = y_at(x0);
      double y1 = r.x() > l.x() ? y_at(x0 + cell) : r.y();
      if (y0 > y1) std::swap(y0, y1);
      for (std::int64_t row = row_of(y0 - 1e-9 * cell); row <= row_of(y1 + 1e-9 * cell); ++row) {
        entries.emplace_back(column * (std::int64_t{1} << 32) + row, i);
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size() && entries[j].first == entries[i].first; ++j) {
      const Segment& s = segments[entries[i].second];
      const Segment& t = segments[entries[j].second];
      if (conflict(s, t)) return Crossing{s.ring, s.index, t.ring, t.index, s.a};
    }
  }
  return std::nullopt;
}

std::string ring_name(int ring) {
  return ring == 0 ? std::string("the margin") : fmt::format("hole {}", ring);
}

std::vector<Polyline> rings_of(const Outline& outline) {
  std::vector<Polyline> rings;
  const auto add = [&](const Points2& points) {
    Polyline ring;
    for (Eigen::Index i = 0; i < points.rows(); ++i) ring.push_back(points.row(i).transpose());
    rings.push_back(std::move(ring));
  };
  add(outline.margin);
  for (const Points2& hole : outline.holes) add(hole);
  return rings;
}

}  // namespace detail

namespace {

void check_ring(const detail::Polyline& ring, int number) {
  const std::string name = detail::ring_name(number);
  if (ring.size() < 3) {
    throw Error(ErrorCode::input,
                fmt::format("{} of the outline has {} points; it needs at least 3", name, ring.size()));
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!ring[i].allFinite()) {
      throw Error(ErrorCode::input, fmt::format("point {} of {} is ({}, {}); coordinates must be finite", i,
                                                name, ring[i].x(), ring[i].y()));
    }
  }
  const double length = detail::length_of(ring, true);
  if (!(std::abs(detail::signed_area(ring)) > 1e-9 * length * length)) {
    throw Error(ErrorCode::input,
                fmt::format("{} of the outline encloses no area: its points lie on a line", name));
  }
}

}  // namespace

void validate_outline(const Outline& outline) {
  const std::vector<detail::Polyline> rings = detail::rings_of(outline);
  for (std::size_t r = 0; r < rings.size(); ++r) check_ring(rings[r], static_cast<int>(r));
  if (const auto crossing = detail::find_crossing(rings)) {
    const auto next = [&](int ring, int i) {
      return (i + 1) % static_cast<int>(rings[static_cast<std::size_t>(ring)].size());
    };
    throw Error(
        ErrorCode::input,
        fmt::format("the segment from point {} to {} of {} meets the segment from point {} to {} of {}, near "
                    "({:.6g}, {:.6g}); the outline must not cross or touch itself",
                    crossing->index1, next(crossing->ring1, crossing->index1),
                    detail::ring_name(crossing->ring1), crossing->index2,
                    next(crossing->ring2, crossing->index2), detail::ring_name(crossing->ring2),
                    crossing->near.x(), crossing->near.y()));
  }
  for (std::size_t r = 1; r < rings.size(); ++r) {
    if (!detail::is_inside(rings[0], rings[r][0])) {
      throw Error(ErrorCode::input,
                  fmt::format("hole {} of the outline lies outside the margin: remove it", r));
    }
    for (std::size_t q = 1; q < rings.size(); ++q) {
      if (q != r && detail::is_inside(rings[q], rings[r][0])) {
        throw Error(ErrorCode::input,
                    fmt::format("hole {} of the outline lies inside hole {}: remove it", r, q));
      }
    }
  }
}

}  // namespace wilt
