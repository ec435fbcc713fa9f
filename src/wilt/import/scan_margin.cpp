#include "wilt/import/scan_margin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/leaf/triangulation.hpp"

namespace wilt::detail {
namespace {

constexpr double kAlpha = 1.6;       // circumradius of a triangle of the shape at most, in coarse spacings
constexpr double kLeastHole = 16.0;  // area of a hole that is kept, in squares of a coarse spacing
constexpr double kSmoothing = 0.5;   // standard deviation of the rings' smoothing, in spacing and noise
constexpr double kOutwards = 0.4;    // in spacings
constexpr double kInwards = 0.5;     // in units of the noise

double circumradius(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double twice_area = std::abs(cross(b - a, c - a));
  return (b - a).norm() * (c - b).norm() * (a - c).norm() / std::max(2.0 * twice_area, 1e-300);
}

// Triangles of a triangulation that make up a shape.
class Shape {
 public:
  Shape(const Triangulation& whole, const Polyline& points, double alpha)
      : whole_(whole), points_(points), kept_(whole.corners.size(), 0) {
    for (int t = 0; t < whole.count(); ++t) {
      const auto& c = whole.corners[t];
      kept_[t] = circumradius(point(c[0]), point(c[1]), point(c[2])) <= alpha;
    }
    do keep_largest_piece();
    while (drop_pinches());
  }

  bool has(int triangle) const { return triangle >= 0 && kept_[triangle]; }

  // Margin counter-clockwise, holes clockwise.
  std::vector<std::vector<int>> rings() const {
    std::map<int, int> next;  // no point is left twice, for there are no pinches
    for (int t = 0; t < whole_.count(); ++t) {
      if (!has(t)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!has(whole_.across[t][k])) next[whole_.corners[t][(k + 1) % 3]] = whole_.corners[t][(k + 2) % 3];
      }
    }
    std::vector<std::vector<int>> rings;
    while (!next.empty()) {
      std::vector<int> ring;
      for (auto it = next.begin(); it != next.end(); it = next.find(ring.back())) {
        ring.push_back(it->second);
        next.erase(it);
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Vec2& point(int i) const { return points_[i]; }

  // What hangs together by shared edges among some of the triangles.
  std::vector<std::vector<int>> pieces(const std::vector<int>& triangles) const {
    std::map<int, bool> seen;
    for (const int t : triangles) seen[t] = false;
    std::vector<std::vector<int>> result;
    for (const int start : triangles) {
      if (std::exchange(seen[start], true)) continue;
      std::vector<int> piece{start};
      for (std::size_t i = 0; i < piece.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const int other = whole_.across[piece[i]][k];
          const auto found = seen.find(other);
          if (found == seen.end() || found->second) continue;
          found->second = true;
          piece.push_back(other);
        }
      }
      result.push_back(std::move(piece));
    }
    return result;
  }

  double area(const std::vector<int>& piece) const {
    double twice = 0.0;
    for (const int t : piece) {
      const auto& c = whole_.corners[t];
      twice += cross(point(c[1]) - point(c[0]), point(c[2]) - point(c[0]));
    }
    return twice / 2;
  }

  void drop_all_but_largest(const std::vector<std::vector<int>>& pieces) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) best = area(pieces[i]) > area(pieces[best]) ? i : best;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i == best) continue;
      for (const int t : pieces[i]) kept_[t] = 0;
    }
  }

  void keep_largest_piece() {
    std::vector<int> all;
    for (int t = 0; t < whole_.count(); ++t) {
      if (has(t)) all.push_back(t);
    }
    drop_all_but_largest(pieces(all));
  }

  // Where triangles meet at a point in several fans, the largest fan stays.
  bool drop_pinches() {
    std::map<int, std::vector<int>> around;
    for (int t = 0; t < whole_.count(); ++t) {
      if (!has(t)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (has(whole_.across[t][k])) continue;
        for (const std::size_t end : {(k + 1) % 3, (k + 2) % 3}) around[whole_.corners[t][end]];
      }
    }
    for (int t = 0; t < whole_.count(); ++t) {
      if (!has(t)) continue;
      for (const int corner : whole_.corners[t]) {
        if (const auto found = around.find(corner); found != around.end()) found->second.push_back(t);
      }
    }
    bool dropped = false;
    for (auto& [corner, triangles] : around) {
      triangles.erase(std::remove_if(triangles.begin(), triangles.end(), [&](int t) { return !has(t); }),
                      triangles.end());
      const auto fans = pieces(triangles);
      if (fans.size() < 2) continue;
      drop_all_but_largest(fans);
      dropped = true;
    }
    return dropped;
  }

  const Triangulation& whole_;
  const Polyline& points_;
  std::vector<char> kept_;
};

// Rings run with the shape on their left, so outwards is to the right.
Polyline settle(const Polyline& ring, double deviation, double outwards, double step) {
  const int count = std::max(12, static_cast<int>(length_of(ring, true) / step));
  Polyline smooth = resample_ring(ring, count);
  const double width = length_of(ring, true) / count;
  smooth_ring(smooth, std::max(1, static_cast<int>(2.0 * deviation * deviation / (width * width))));
  Polyline moved = smooth;
  for (std::size_t i = 0, n = smooth.size(); i < n; ++i) {
    const Vec2 along = (smooth[(i + 1) % n] - smooth[(i + n - 1) % n]).normalized();
    moved[i] += outwards * Vec2(along.y(), -along.x());
  }
  return moved;
}

Points2 to_points(const Polyline& ring) {
  Points2 points(static_cast<Eigen::Index>(ring.size()), 2);
  for (std::size_t i = 0; i < ring.size(); ++i) points.row(i) = ring[i].transpose();
  return points;
}

Outline settled(const std::vector<Polyline>& rings, double deviation, const ScanMarginOptions& options) {
  const double least_hole = kLeastHole * options.coarse_spacing * options.coarse_spacing;
  std::size_t margin = 0;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (signed_area(rings[i]) > signed_area(rings[margin])) margin = i;
  }
  Outline outline;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (i != margin && -signed_area(rings[i]) < least_hole) continue;
    const Points2 ring = to_points(settle(
        rings[i], deviation, kOutwards * options.spacing - kInwards * options.noise, 0.5 * options.spacing));
    if (i == margin)
      outline.margin = ring;
    else
      outline.holes.push_back(ring);
  }
  return outline;
}

}  // namespace

ScanMargin find_scan_margin(const Points2& points, const ScanMarginOptions& options) {
  // Points at one place for the triangulation's grid are one.
  std::map<std::pair<long, long>, int> distinct;
  Polyline places;
  std::vector<int> place_of(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vec2 at = points.row(i).transpose() / (1e-3 * options.spacing);
    const auto [it, fresh] = distinct.emplace(std::pair(std::lround(at.x()), std::lround(at.y())),
                                              static_cast<int>(places.size()));
    if (fresh) places.push_back(points.row(i).transpose());
    place_of[i] = it->second;
  }
  const Triangulation whole = delaunay(places);
  const Shape shape(whole, places, kAlpha * options.coarse_spacing);
  std::vector<char> used(places.size(), 0);
  for (int t = 0; t < whole.count(); ++t) {
    if (!shape.has(t)) continue;
    for (const int corner : whole.corners[t]) used[corner] = 1;
  }
  ScanMargin result;
  for (const int place : place_of) result.inside.push_back(used[place]);

  std::vector<Polyline> rings;
  for (const std::vector<int>& ring : shape.rings()) {
    rings.emplace_back();
    for (const int i : ring) rings.back().push_back(places[i]);
  }
  if (rings.empty()) throw Error(ErrorCode::input, "the points are too sparse to show where the leaf ends");
  for (const double more : {1.0, 1.5, 2.0, 3.0}) {
    result.outline = settled(rings, more * kSmoothing * (options.spacing + options.noise), options);
    try {
      validate_outline(result.outline);
      return result;
    } catch (const Error& error) {
      if (more == 3.0)
        throw Error(ErrorCode::input, std::string("the margin of the scan is too ragged: ") + error.what());
    }
  }
  return result;
}

}  // namespace wilt::detail
