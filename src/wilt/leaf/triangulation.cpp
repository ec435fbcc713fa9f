#include "wilt/leaf/triangulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

}  // namespace

int Triangulation::corner_index(int triangle, int point) const {
  const auto& c = corners[at(triangle)];
  return c[0] == point ? 0 : c[1] == point ? 1 : 2;
}

int Triangulation::edge_towards(int triangle, int neighbour) const {
  const auto& a = across[at(triangle)];
  return a[0] == neighbour ? 0 : a[1] == neighbour ? 1 : 2;
}

void Triangulation::flip(int triangle, int k) {
  const int other = across[at(triangle)][at(k)];
  const int j = edge_towards(other, triangle);
  auto& tc = corners[at(triangle)];
  auto& uc = corners[at(other)];
  const int p = tc[at(k)], a = tc[at((k + 1) % 3)], b = tc[at((k + 2) % 3)], q = uc[at(j)];
  const int beyond_aq = across[at(other)][at((j + 1) % 3)];
  const int beyond_qb = across[at(other)][at((j + 2) % 3)];
  const int beyond_bp = across[at(triangle)][at((k + 1) % 3)];
  const int beyond_pa = across[at(triangle)][at((k + 2) % 3)];
  tc = {p, a, q};
  uc = {q, b, p};
  across[at(triangle)] = {beyond_aq, other, beyond_pa};
  across[at(other)] = {beyond_bp, triangle, beyond_qb};
  if (beyond_aq >= 0) across[at(beyond_aq)][at(edge_towards(beyond_aq, other))] = triangle;
  if (beyond_bp >= 0) across[at(beyond_bp)][at(edge_towards(beyond_bp, triangle))] = other;
  triangle_of[at(p)] = triangle_of[at(a)] = triangle;
  triangle_of[at(q)] = triangle_of[at(b)] = other;
}

void Triangulation::connect(int point_count) {
  // Every edge is entered at its smaller point; its two triangles meet there.
  across.assign(corners.size(), {-1, -1, -1});
  triangle_of.assign(at(point_count), -1);
  std::vector<int> first(at(point_count) + 1, 0);
  const auto ends = [&](std::size_t t, int k) {
    const int a = corners[t][at((k + 1) % 3)];
    const int b = corners[t][at((k + 2) % 3)];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      ++first[at(ends(t, k).first) + 1];
      triangle_of[at(corners[t][at(k)])] = static_cast<int>(t);
    }
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  struct Entry {
    int far, triangle, edge;
  };
  std::vector<Entry> entries(3 * corners.size());
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = ends(t, k);
      int& end = filled[at(low)];
      for (int i = first[at(low)]; i < end; ++i) {
        if (entries[at(i)].far != high) continue;
        across[t][at(k)] = entries[at(i)].triangle;
        across[at(entries[at(i)].triangle)][at(entries[at(i)].edge)] = static_cast<int>(t);
      }
      entries[at(end++)] = {high, static_cast<int>(t), k};
    }
  }
}

Triangulation delaunay(const Polyline& points) {
  using Site = boost::polygon::point_data<std::int32_t>;
  Vec2 low = points[0];
  Vec2 high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = std::ldexp(1.0, 29) / (high - low).maxCoeff();
  std::vector<Site> sites;
  sites.reserve(points.size());
  for (const Vec2& p : points) {
    sites.emplace_back(static_cast<std::int32_t>(std::lround((p.x() - low.x()) * scale)),
                       static_cast<std::int32_t>(std::lround((p.y() - low.y()) * scale)));
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);
  const auto twice_area = [&](int a, int b, int c) {
    const auto x = [&](int i) { return std::int64_t{sites[at(i)].x()}; };
    const auto y = [&](int i) { return std::int64_t{sites[at(i)].y()}; };
    return (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
  };
  Triangulation result;
  result.corners.reserve(2 * points.size());
  std::vector<int> around;
  for (const auto& vertex : diagram.vertices()) {
    around.clear();
    const auto* edge = vertex.incident_edge();
    do {
      around.push_back(static_cast<int>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    for (std::size_t i = 1; i + 1 < around.size(); ++i) {
      const std::int64_t area = twice_area(around[0], around[i], around[i + 1]);
      if (area > 0) result.corners.push_back({around[0], around[i], around[i + 1]});
      if (area < 0) result.corners.push_back({around[0], around[i + 1], around[i]});
    }
  }
  result.connect(static_cast<int>(points.size()));
  return result;
}

namespace {

// A diagonal of a triangulation as its two ends.
using Diagonal = std::array<int, 2>;

// The triangle left of the edge from a to b and the edge's index in it, or -1.
std::pair<int, int> find_edge(const Triangulation& t, int a, int b) {
  std::pair<int, int> found{-1, -1};
  for_fan(t, a, [&](int triangle, int k) {
    if (t.corners[at(triangle)][at((k + 1) % 3)] == b) found = {triangle, (k + 2) % 3};
  });
  return found;
}

// The edges that the open segment from a to b crosses, in order.
std::vector<Diagonal> crossed_edges(const Triangulation& t, const Polyline& points, int a, int b) {
  const Vec2& pa = points[at(a)];
  const Vec2& pb = points[at(b)];
  int triangle = -1, edge = -1;
  for_fan(t, a, [&](int candidate, int k) {
    const auto& c = t.corners[at(candidate)];
    if (turn(pa, pb, points[at(c[at((k + 1) % 3)])]) < 0 &&
        turn(pa, pb, points[at(c[at((k + 2) % 3)])]) > 0) {
      triangle = candidate;
      edge = k;
    }
  });
  std::vector<Diagonal> result;
  while (triangle >= 0) {
    const auto& c = t.corners[at(triangle)];
    const int right = c[at((edge + 1) % 3)], left = c[at((edge + 2) % 3)];
    result.push_back({right, left});
    const int next = t.across[at(triangle)][at(edge)];
    if (next < 0) return {};
    const int k = t.edge_towards(next, triangle);
    const int ahead = t.corners[at(next)][at(k)];
    if (ahead == b) return result;
    // Beyond the far corner on the right, the segment leaves through the edge on the left, and conversely.
    const bool ahead_is_left = turn(pa, pb, points[at(ahead)]) > 0;
    edge = t.corner_index(next, ahead_is_left ? left : right);
    triangle = next;
  }
  return {};
}

bool convex(const Triangulation& t, const Polyline& points, int triangle, int k) {
  const int other = t.across[at(triangle)][at(k)];
  const auto& c = t.corners[at(triangle)];
  const Vec2& p = points[at(c[at(k)])];
  const Vec2& a = points[at(c[at((k + 1) % 3)])];
  const Vec2& b = points[at(c[at((k + 2) % 3)])];
  const Vec2& q = points[at(t.corners[at(other)][at(t.edge_towards(other, triangle))])];
  return turn(p, a, q) > 0 && turn(q, b, p) > 0;
}

bool recover(Triangulation& t, const Polyline& points, int a, int b) {
  if (find_edge(t, a, b).first >= 0 || find_edge(t, b, a).first >= 0) return true;
  std::vector<Diagonal> queue = crossed_edges(t, points, a, b);
  if (queue.empty()) return false;
  std::size_t budget = 50 * queue.size() * queue.size() + 1000;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (budget-- == 0) return false;
    const auto [triangle, k] = find_edge(t, queue[i][0], queue[i][1]);
    if (triangle < 0) return false;
    if (!convex(t, points, triangle, k)) {
      queue.push_back(queue[i]);
      continue;
    }
    const int p = t.corners[at(triangle)][at(k)];
    t.flip(triangle, k);
    const int q = t.corners[at(triangle)][2];
    if (p == a || p == b || q == a || q == b) continue;
    const double side_p = turn(points[at(a)], points[at(b)], points[at(p)]);
    const double side_q = turn(points[at(a)], points[at(b)], points[at(q)]);
    if ((side_p > 0) != (side_q > 0)) queue.push_back({p, q});
  }
  return find_edge(t, a, b).first >= 0 || find_edge(t, b, a).first >= 0;
}

// Triangles separated from triangle 0's side by an odd number of rings are inside.
std::vector<char> inside_triangles(const Triangulation& t, const std::vector<std::array<char, 3>>& wall,
                                   int start) {
  std::vector<char> depth(t.corners.size(), -1);
  std::vector<int> now{start}, beyond;
  for (char level = 0; !now.empty(); ++level) {
    while (!now.empty()) {
      const int triangle = now.back();
      now.pop_back();
      if (depth[at(triangle)] >= 0) continue;
      depth[at(triangle)] = level;
      for (int k = 0; k < 3; ++k) {
        const int next = t.across[at(triangle)][at(k)];
        if (next >= 0 && depth[at(next)] < 0) (wall[at(triangle)][at(k)] ? beyond : now).push_back(next);
      }
    }
    now.swap(beyond);
  }
  return depth;
}

}  // namespace

Triangulation fill_rings(const Polyline& points, const std::vector<std::vector<int>>& rings) {
  // Four far corners, so that every ring segment has triangles on both sides.
  Polyline all = points;
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double reach = 0.5 * (high - low).norm();
  for (const Vec2& corner :
       {Vec2(low.x() - reach, low.y() - reach), Vec2(high.x() + reach, low.y() - reach),
        Vec2(high.x() + reach, high.y() + reach), Vec2(low.x() - reach, high.y() + reach)}) {
    all.push_back(corner);
  }
  Triangulation whole = delaunay(all);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const int a = rings[r][i], b = rings[r][(i + 1) % rings[r].size()];
      if (whole.triangle_of[at(a)] >= 0 && whole.triangle_of[at(b)] >= 0 && recover(whole, all, a, b))
        continue;
      throw Error(
          ErrorCode::input,
          fmt::format("the outline cannot be meshed near ({:.6g}, {:.6g}): it nearly touches itself there; "
                      "simplify it or ask for more vertices",
                      points[at(a)].x(), points[at(a)].y()));
    }
  }
  std::vector<std::array<char, 3>> wall(whole.corners.size(), {0, 0, 0});
  for (const std::vector<int>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (const auto& [a, b] : {std::pair(ring[i], ring[(i + 1) % ring.size()]),
                                 std::pair(ring[(i + 1) % ring.size()], ring[i])}) {
        const auto [triangle, k] = find_edge(whole, a, b);
        if (triangle >= 0) wall[at(triangle)][at(k)] = 1;
      }
    }
  }
  const std::vector<char> depth = inside_triangles(whole, wall, whole.triangle_of[points.size()]);
  Triangulation inside;
  for (std::size_t t = 0; t < whole.corners.size(); ++t) {
    if (depth[t] % 2 == 1) inside.corners.push_back(whole.corners[t]);
  }
  inside.connect(static_cast<int>(points.size()));
  return inside;
}

int make_delaunay(Triangulation& t, const Polyline& points) {
  std::vector<std::pair<int, int>> stack;
  for (int triangle = 0; triangle < t.count(); ++triangle) {
    for (int k = 0; k < 3; ++k) {
      if (t.across[at(triangle)][at(k)] > triangle) stack.emplace_back(triangle, k);
    }
  }
  int flips = 0;
  const int limit = 20 * t.count() + 100;
  while (!stack.empty() && flips < limit) {
    const auto [triangle, k] = stack.back();
    stack.pop_back();
    const int other = t.across[at(triangle)][at(k)];
    if (other < 0) continue;
    const auto& c = t.corners[at(triangle)];
    const Vec2& p = points[at(c[at(k)])];
    const Vec2& a = points[at(c[at((k + 1) % 3)])];
    const Vec2& b = points[at(c[at((k + 2) % 3)])];
    const Vec2& q = points[at(t.corners[at(other)][at(t.edge_towards(other, triangle))])];
    // The opposite angles sum to more than pi when the sine of their sum is negative; the slack ends ties.
    const double cos_p = (a - p).dot(b - p), sin_p = cross(a - p, b - p);
    const double cos_q = (b - q).dot(a - q), sin_q = cross(b - q, a - q);
    const double scale = (a - p).norm() * (b - p).norm() * (a - q).norm() * (b - q).norm();
    if (sin_p * cos_q + cos_p * sin_q >= -1e-10 * scale || !convex(t, points, triangle, k)) continue;
    t.flip(triangle, k);
    ++flips;
    for (const int changed : {triangle, other}) {
      for (int e = 0; e < 3; ++e) {
        if (t.across[at(changed)][at(e)] >= 0) stack.emplace_back(changed, e);
      }
    }
  }
  return flips;
}

}  // namespace wilt::detail
