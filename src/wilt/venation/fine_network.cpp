#include "wilt/venation/fine_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/hash.hpp"

namespace wilt {
namespace {

std::uint64_t lattice_hash(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  return mix_hash(mix_hash(seed, static_cast<std::uint64_t>(i)), static_cast<std::uint64_t>(j));
}

// Walls `width` of a cell wide: 1 on a wall, 0 in a cell.
double ridge(const CellWall& wall, double width) {
  const double x = std::min(wall.distance / width, 1.0);
  return (1.0 - x * x) * (1.0 - x * x);
}

}  // namespace

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

FineNetwork fine_network(const Vec2& p, std::uint64_t seed) {
  // Bent at two sizes, so that the walls are no straight lines.
  const auto bent = [&p, seed](double frequency, double reach, std::uint64_t purpose) -> Vec2 {
    return reach * Vec2(value_noise(p * frequency, mix_hash(seed, purpose)).value,
                        value_noise(p * frequency, mix_hash(seed, purpose + 1)).value);
  };
  const Vec2 coarse = p + bent(31.0, 0.006, 11), fine = coarse + bent(110.0, 0.0012, 21);
  const double fade = std::clamp(1.2 + value_noise(p * 80.0, mix_hash(seed, 31)).value, 0.3, 1.0);
  FineNetwork network;
  const CellWall tertiary = cell_wall(coarse * 22.0, mix_hash(seed, 3));
  network.tertiary = ridge(tertiary, 0.15);
  network.within = tertiary.distance;
  network.quaternary = fade * ridge(cell_wall(fine * 60.0, mix_hash(seed, 4)), 0.20);
  network.areole = fade * fade * ridge(cell_wall(fine * 150.0, mix_hash(seed, 5)), 0.26);
  return network;
}

}  // namespace wilt
