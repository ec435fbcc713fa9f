#include "wilt/render/detail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/render/sampling.hpp"

namespace wilt {
namespace {

std::uint64_t lattice_hash(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  return mix_hash(mix_hash(seed, static_cast<std::uint64_t>(i)), static_cast<std::uint64_t>(j));
}

// Walls of one size of cells as ridges `width` cells wide; `frequency` cells in a unit of length.
void add_network(FineDetail& detail, const Vec2& p, double frequency, double width, double steepness,
                 double strength, std::uint64_t seed) {
  const CellWall wall = cell_wall(p * frequency, seed);
  if (wall.distance >= width) return;
  const double x = wall.distance / width, height = (1.0 - x * x) * (1.0 - x * x);
  detail.vein = std::max(detail.vein, strength * height);
  detail.slope += (-steepness * 4.0 * x * (1.0 - x * x)) * wall.gradient;
}

}  // namespace

double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Noise value_noise(const Vec2& p, std::uint64_t seed) {
  const double fx = std::floor(p.x()), fy = std::floor(p.y());
  const auto value = [&](int i, int j) {
    return 2.0 * hash_uniform(lattice_hash(std::int64_t(fx) + i, std::int64_t(fy) + j, seed)) - 1.0;
  };
  const double x = p.x() - fx, y = p.y() - fy;
  const double sx = x * x * (3.0 - 2.0 * x), sy = y * y * (3.0 - 2.0 * y);
  const double v00 = value(0, 0), v10 = value(1, 0), v01 = value(0, 1), v11 = value(1, 1);
  const double bottom = v00 + sx * (v10 - v00), top = v01 + sx * (v11 - v01);
  const double across = (v10 - v00) + sy * ((v11 - v01) - (v10 - v00));
  return {bottom + sy * (top - bottom), {6.0 * x * (1.0 - x) * across, 6.0 * y * (1.0 - y) * (top - bottom)}};
}

CellWall cell_wall(const Vec2& p, std::uint64_t seed) {
  const auto ci = static_cast<std::int64_t>(std::floor(p.x())),
             cj = static_cast<std::int64_t>(std::floor(p.y()));
  double first = std::numeric_limits<double>::infinity(), second = first;
  Vec2 nearest(0.0, 0.0), other(0.0, 0.0);
  for (std::int64_t j = cj - 1; j <= cj + 1; ++j) {
    for (std::int64_t i = ci - 1; i <= ci + 1; ++i) {
      const std::uint64_t hash = lattice_hash(i, j, seed);
      const Vec2 site(double(i) + double(hash & 0xffffffffu) * 0x1.0p-32,
                      double(j) + double(hash >> 32) * 0x1.0p-32);
      const double distance = (site - p).squaredNorm();
      if (distance < first) {
        second = first, other = nearest;
        first = distance, nearest = site;
      } else if (distance < second) {
        second = distance, other = site;
      }
    }
  }
  const Vec2 across = (other - nearest).normalized();
  return {(0.5 * (nearest + other) - p).dot(across), -across};
}

FineDetail fine_detail(const Vec2& p, std::uint64_t seed) {
  FineDetail detail;
  // Bent a little, so that the walls are no straight lines.
  const Noise bend_x = value_noise(p * 31.0, mix_hash(seed, 1)),
              bend_y = value_noise(p * 31.0, mix_hash(seed, 2));
  const Vec2 bent = p + 0.006 * Vec2(bend_x.value, bend_y.value);
  add_network(detail, bent, 24.0, 0.16, 0.20, 1.0, mix_hash(seed, 3));
  add_network(detail, bent, 72.0, 0.22, 0.16, 0.6, mix_hash(seed, 4));

  const Noise crinkle = value_noise(p * 42.0, mix_hash(seed, 5)),
              grain = value_noise(p * 160.0, mix_hash(seed, 6));
  detail.slope += 0.09 * crinkle.gradient + 0.05 * grain.gradient;
  detail.tone =
      0.6 * value_noise(p * 7.0, mix_hash(seed, 7)).value + 0.3 * crinkle.value + 0.25 * grain.value;
  return detail;
}

}  // namespace wilt
