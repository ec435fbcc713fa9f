#include "wilt/leaf/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wilt::detail {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// The points opposite to `point` in the triangles around it: edges (right, left) as seen from it.
struct Fan {
  std::vector<std::array<int, 2>> edges;

  void collect(const Triangulation& t, int point) {
    edges.clear();
    for_fan(t, point, [&](int triangle, int k) {
      const auto& c = t.corners[at(triangle)];
      edges.push_back({c[at((k + 1) % 3)], c[at((k + 2) % 3)]});
    });
  }
};

double smallest_area(const Fan& fan, const Polyline& points, const Vec2& p) {
  double smallest = 1e300;
  for (const auto& [a, b] : fan.edges)
    smallest = std::min(smallest, cross(points[at(a)] - p, points[at(b)] - p));
  return smallest;
}

double smallest_angle_around(const Fan& fan, const Polyline& points, const Vec2& p) {
  double smallest = 1e300;
  for (const auto& [a, b] : fan.edges)
    smallest = std::min(smallest, smallest_corner(p, points[at(a)], points[at(b)]));
  return smallest;
}

// The circumcentre of a triangle, kept within `reach` of its centroid.
Vec2 tame_circumcentre(const Vec2& a, const Vec2& b, const Vec2& c, double reach) {
  const Vec2 u = b - a, v = c - a;
  const Vec2 centroid = (a + b + c) / 3.0;
  const double twice = cross(u, v);
  if (twice <= 0.0) return centroid;
  const Vec2 centre = a + Vec2(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                               u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
                              (2.0 * twice);
  const double away = (centre - centroid).norm();
  return away <= reach ? centre : Vec2(centroid + (centre - centroid) * (reach / away));
}

void move_to_optimum(const Fan& fan, Polyline& points, int point, double edge) {
  Vec2& p = points[at(point)];
  Vec2 sum = Vec2::Zero();
  double total = 0.0;
  for (const auto& [a, b] : fan.edges) {
    const double area = cross(points[at(a)] - p, points[at(b)] - p);
    sum += area * tame_circumcentre(p, points[at(a)], points[at(b)], 0.5 * edge);
    total += area;
  }
  if (!(total > 0.0)) return;
  const double floor_area = std::min(0.5 * smallest_area(fan, points, p), 0.3 * edge * edge);
  Vec2 step = sum / total - p;
  for (int halving = 0; halving < 4; ++halving, step *= 0.5) {
    if (smallest_area(fan, points, p + step) >= floor_area) {
      p += step;
      return;
    }
  }
}

// The unit vector out of the blade at a point of the margin: away from the middle of its border neighbours'
// chord on the outer side.
Vec2 outward(const Fan& fan, const Polyline& points) {
  // The border edges belong to neighbours that occur only once in the fan.
  std::array<int, 2> ends{-1, -1};
  for (const auto& edge : fan.edges) {
    const auto is_right = [&](int v) {
      return std::any_of(fan.edges.begin(), fan.edges.end(), [&](const auto& e) { return e[0] == v; });
    };
    const auto is_left = [&](int v) {
      return std::any_of(fan.edges.begin(), fan.edges.end(), [&](const auto& e) { return e[1] == v; });
    };
    if (!is_left(edge[0])) ends[0] = edge[0];
    if (!is_right(edge[1])) ends[1] = edge[1];
  }
  if (ends[0] < 0 || ends[1] < 0) return Vec2::Zero();
  // The margin runs from ends[1] over the point to ends[0], with the blade on its left.
  const Vec2 along = points[at(ends[0])] - points[at(ends[1])];
  return Vec2(along.y(), -along.x()).normalized();
}

bool widen_around(const Triangulation& t, Polyline& points, int point, Mobility mobility, double edge) {
  Fan fan;
  fan.collect(t, point);
  const Vec2 out = mobility == Mobility::margin ? outward(fan, points) : Vec2::Zero();
  double best = smallest_angle_around(fan, points, points[at(point)]);
  bool moved = false;
  for (double step = 0.25 * edge; step > 0.01 * edge;) {
    Vec2 best_place = points[at(point)];
    const double before = best;
    for (int k = 0; k < 12; ++k) {
      const double direction = 2.0 * std::numbers::pi * k / 12.0;
      const Vec2 d(std::cos(direction), std::sin(direction));
      if (mobility == Mobility::margin && d.dot(out) > 1e-9) continue;
      const Vec2 place = points[at(point)] + step * d;
      const double angle = smallest_angle_around(fan, points, place);
      if (angle > best + 1e-6) {
        best = angle;
        best_place = place;
      }
    }
    if (best > before) {
      points[at(point)] = best_place;
      moved = true;
    } else {
      step *= 0.5;
    }
  }
  return moved;
}

}  // namespace

double smallest_corner(const Vec2& a, const Vec2& b, const Vec2& c) {
  const std::array<Vec2, 3> p{a, b, c};
  double smallest = std::numbers::pi;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 u = p[(k + 1) % 3] - p[k];
    const Vec2 v = p[(k + 2) % 3] - p[k];
    smallest = std::min(smallest, std::atan2(cross(u, v), u.dot(v)));
  }
  return smallest;
}

void relax(Triangulation& t, Polyline& points, const std::vector<Mobility>& mobility, double edge,
           int sweeps) {
  Fan fan;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (mobility[v] != Mobility::inner) continue;
      fan.collect(t, static_cast<int>(v));
      move_to_optimum(fan, points, static_cast<int>(v), edge);
    }
    make_delaunay(t, points);
  }
}

double widen_angles(Triangulation& t, Polyline& points, const std::vector<Mobility>& mobility, double edge,
                    double angle, int rounds) {
  for (int round = 0;; ++round) {
    double smallest = std::numbers::pi;
    std::vector<int> corners;
    for (const auto& c : t.corners) {
      const double corner = smallest_corner(points[at(c[0])], points[at(c[1])], points[at(c[2])]);
      smallest = std::min(smallest, corner);
      if (corner < angle) corners.insert(corners.end(), c.begin(), c.end());
    }
    if (corners.empty() || round == rounds) return smallest;
    // Every other round the neighbours move too, which makes room.
    if (round % 2 == 1) {
      const std::vector<int> inner = corners;
      for (const int v : inner) {
        for_fan(t, v, [&](int triangle, int) {
          const auto& c = t.corners[at(triangle)];
          corners.insert(corners.end(), c.begin(), c.end());
        });
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    bool moved = false;
    for (const int v : corners) {
      if (mobility[at(v)] != Mobility::fixed) moved |= widen_around(t, points, v, mobility[at(v)], edge);
    }
    if (make_delaunay(t, points) == 0 && !moved && round % 2 == 1) return smallest;
  }
}

}  // namespace wilt::detail
