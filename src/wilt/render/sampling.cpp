#include "wilt/render/sampling.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace wilt {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// A permutation in which a bit depends on the bits below it alone: the factors are even (Laine and Karras
// 2011; factors as in Burley). On the reversed word that is Owen's nested scrambling.
std::uint32_t nested_permutation(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  for (const std::uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u}) x ^= x * factor;
  return x;
}

// The second dimension of Sobol's sequence: its generator matrix is Pascal's triangle modulo 2.
std::uint32_t sobol_second(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 1u << 31; i != 0; i >>= 1, column ^= column >> 1)
    if (i & 1u) result ^= column;
  return result;
}

}  // namespace

Vec2 Sampler::next() {
  const std::uint64_t h = mix_hash(hash_, 2 * dimension_), g = mix_hash(hash_, 2 * dimension_ + 1);
  ++dimension_;
  const std::uint32_t i = nested_permutation(index_, std::uint32_t(h)) & mask_;
  const std::uint32_t x = nested_permutation(i, std::uint32_t(h >> 32));
  const std::uint32_t y = nested_permutation(reverse_bits(sobol_second(i)), std::uint32_t(g));
  return {reverse_bits(x) * 0x1.0p-32, reverse_bits(y) * 0x1.0p-32};
}

Frame3::Frame3(const Vec3& unit_normal) : n(unit_normal) {
  s = (std::abs(n.x()) > 0.7 ? Vec3::UnitY() : Vec3::UnitX()).cross(n).normalized();
  t = n.cross(s);
}

Vec3 sample_cosine(const Vec2& u) {
  const double r = std::sqrt(u.x()), phi = 2.0 * std::numbers::pi * u.y();
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - u.x())};
}

Vec3 sample_cap(const Vec2& u, double radius) {
  const double z = 1.0 - u.x() * (1.0 - std::cos(radius)), phi = 2.0 * std::numbers::pi * u.y();
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3 sample_visible_normal(const Vec2& u, const Vec3& view, double alpha) {
  const Vec3 w = Vec3(alpha * view.x(), alpha * view.y(), view.z()).normalized();
  const double z = (1.0 - u.x()) * (1.0 + w.z()) - w.z(), phi = 2.0 * std::numbers::pi * u.y();
  const double r = std::sqrt(std::clamp(1.0 - z * z, 0.0, 1.0));
  const Vec3 h = Vec3(r * std::cos(phi), r * std::sin(phi), z) + w;
  return Vec3(alpha * h.x(), alpha * h.y(), std::max(h.z(), 1e-9)).normalized();
}

}  // namespace wilt
