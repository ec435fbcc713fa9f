#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "wilt/core/check.hpp"
#include "wilt/leaf/margin_sampling.hpp"
#include "wilt/leaf/outline.hpp"
#include "wilt/leaf/relaxation.hpp"
#include "wilt/leaf/rings.hpp"
#include "wilt/leaf/triangulation.hpp"

namespace wilt {
namespace {

using namespace detail;

constexpr int kSweeps = 12;             // of relaxation
constexpr int kRounds = 40;             // of widening angles
constexpr double kAngleReserve = 0.06;  // radians aimed for above the angle that is promised

struct Filling {
  SampledMargin margin;
  Polyline inside;
  double edge = 0.0;
};

// The edge length whose triangles number as wanted: V = 2 A / (sqrt(3) e^2) + L / (2 e) + 1 by Euler's
// formula.
double edge_for(double area, double length, int vertices) {
  const double a = 2.0 / std::sqrt(3.0) * area;
  const double n = vertices - 1.0;
  return (0.25 * length + std::sqrt(0.0625 * length * length + n * a)) / n;
}

Filling fill_to_count(const std::vector<Polyline>& rings, const MeshingOptions& options, double smoothing,
                      const Monitor& monitor) {
  constexpr int kTries = 10;
  double area = 0.0, length = 0.0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    area += (r == 0 ? 1.0 : -1.0) * std::abs(signed_area(rings[r]));
    length += length_of(rings[r], true);
  }
  // A jagged outline is much longer than the smooth one; a leaf's is at most some times its hull's.
  double edge = edge_for(area, std::min(length, 12.0 * std::sqrt(area)), options.vertices);
  Filling best;
  int best_error = 1 << 30;
  for (int k = 0; k < kTries; ++k) {
    monitor.throw_if_cancelled();
    Filling filling;
    filling.edge = edge;
    filling.margin = sample_margin(rings, options.keep, edge, smoothing);
    filling.inside = hexagonal_points(filling.margin, edge);
    const int count = static_cast<int>(filling.margin.points.size() + filling.inside.size());
    const int error = std::abs(count - options.vertices);
    if (error < best_error) {
      best_error = error;
      best = std::move(filling);
    }
    if (error <= std::max(1, options.vertices / 400)) break;
    edge *= std::pow(double(count) / options.vertices, 0.55);
  }
  return best;
}

// The place of a cell on Hilbert's curve over a 2^16 x 2^16 grid.
std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t s = 1u << 15; s > 0; s /= 2) {
    const std::uint32_t rx = (x & s) ? 1 : 0, ry = (y & s) ? 1 : 0;
    place += std::uint64_t{s} * s * ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = 65535 - x;
        y = 65535 - y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

// The vertices in the order of Hilbert's curve.
std::vector<int> local_order(const Polyline& points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = 65535.0 / (high - low).maxCoeff();
  std::vector<std::pair<std::uint64_t, int>> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 q = (points[i] - low) * scale;
    places.emplace_back(hilbert(static_cast<std::uint32_t>(q.x()), static_cast<std::uint32_t>(q.y())),
                        int(i));
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  for (const auto& place : places) order.push_back(place.second);
  return order;
}

PlanarMesh to_mesh(const Triangulation& t, const Polyline& points, const std::vector<int>& kept) {
  const std::vector<int> order = local_order(points);
  std::vector<int> renamed(points.size());
  PlanarMesh result;
  result.positions.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < order.size(); ++i) {
    renamed[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    result.positions.row(static_cast<Eigen::Index>(i)) =
        points[static_cast<std::size_t>(order[i])].transpose();
  }
  std::vector<std::array<int, 3>> corners;
  for (std::array<int, 3> c : t.corners) {
    for (int& v : c) v = renamed[static_cast<std::size_t>(v)];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    corners.push_back(c);
  }
  std::sort(corners.begin(), corners.end());
  Faces faces(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t f = 0; f < corners.size(); ++f) {
    faces.row(static_cast<Eigen::Index>(f)) << corners[f][0], corners[f][1], corners[f][2];
  }
  result.mesh = SurfaceMesh(static_cast<int>(points.size()), faces);
  for (const int v : kept) result.kept.push_back(VertexId(renamed[static_cast<std::size_t>(v)]));
  return result;
}

void check_options(const MeshingOptions& options) {
  if (options.vertices < 200 || options.vertices > 1000000) {
    throw Error(
        ErrorCode::configuration,
        fmt::format("{} vertices were asked for; from 200 to 1000000 are possible", options.vertices));
  }
  if (!(options.smallest_angle >= 0.0 && options.smallest_angle <= 0.45)) {
    throw Error(ErrorCode::configuration,
                fmt::format("a smallest angle of {} radians was asked for; from 0 to 0.45 are possible",
                            options.smallest_angle));
  }
  if (!(options.smoothing >= 0.3 && options.smoothing <= 4.0)) {
    throw Error(
        ErrorCode::configuration,
        fmt::format("a smoothing of {} was asked for; from 0.3 to 4 are possible", options.smoothing));
  }
}

}  // namespace

PlanarMesh mesh_outline(const Outline& outline, const MeshingOptions& options, const Monitor& monitor) {
  check_options(options);
  validate_outline(outline);
  std::vector<Polyline> rings = rings_of(outline);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if ((signed_area(rings[r]) > 0.0) != (r == 0)) std::reverse(rings[r].begin(), rings[r].end());
  }
  double reached = 0.0;
  // An outline with needles or necks that defeat the angle is smoothed more.
  for (double smoothing = options.smoothing; smoothing < 4.5; smoothing *= std::numbers::sqrt2) {
    monitor.report("mesh", 0.0);
    Filling filling = fill_to_count(rings, options, smoothing, monitor);
    Polyline points = std::move(filling.margin.points);
    std::vector<Mobility> mobility(points.size(), Mobility::margin);
    for (const int v : filling.margin.kept) mobility[static_cast<std::size_t>(v)] = Mobility::fixed;
    points.insert(points.end(), filling.inside.begin(), filling.inside.end());
    mobility.resize(points.size(), Mobility::inner);
    monitor.report("mesh", 0.3);
    Triangulation triangulation = fill_rings(points, filling.margin.rings);
    monitor.throw_if_cancelled();
    relax(triangulation, points, mobility, filling.edge, kSweeps);
    monitor.report("mesh", 0.8);
    reached = widen_angles(triangulation, points, mobility, filling.edge,
                           options.smallest_angle + kAngleReserve, kRounds);
    if (reached < options.smallest_angle) continue;
    PlanarMesh result = to_mesh(triangulation, points, filling.margin.kept);
    monitor.report("mesh", 1.0);
    return result;
  }
  throw Error(
      ErrorCode::input,
      fmt::format(
          "the outline is too fine for {} vertices: its smallest triangle angle would be {:.1f} degrees, "
          "{:.1f} are needed; ask for more vertices or simplify it",
          options.vertices, reached * 180.0 / std::numbers::pi,
          options.smallest_angle * 180.0 / std::numbers::pi));
}

}  // namespace wilt
