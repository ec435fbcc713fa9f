#include "wilt/core/random.hpp"

#include <cmath>
#include <numbers>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

// FNV-1a over the purpose, started from the seed (Fowler, Noll, Vo; 64-bit parameters).
std::uint64_t mix(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t hash = 14695981039346656037ULL ^ (seed * 0x9E3779B97F4A7C15ULL);
  for (const char c : purpose) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view purpose) : engine_(mix(seed, purpose)) {}

double Random::uniform() {
  return static_cast<double>(engine_() >> 11) * 0x1.0p-53;
}

double Random::uniform(double a, double b) {
  return a + (b - a) * uniform();
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

int Random::index(int n) {
  WILT_CHECK(n >= 1, n);
  return static_cast<int>(uniform() * n);
}

}  // namespace wilt
