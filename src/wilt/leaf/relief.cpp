// Relief of a fresh leaf, in units of its length, y along the midrib, d the distance to the nearest main
// vein:
//   z = v tanh(d / w)                   veins lie in valleys
//     + f (sqrt(x^2 + e^2) - e)         the two halves fold up along the midrib
//     + a y - b y^2 - c x^2             an arch along the blade, a dome across it
//     + sum_k A_k sin(q_k . (x, y) + phi_k), growing from the petiole outwards
// The coefficients are ours, chosen for slopes below about 0.4.
#include "wilt/leaf/relief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "wilt/core/random.hpp"

namespace wilt {

Relief::Relief(std::vector<Vec2> tips, std::uint64_t seed) : tips_(std::move(tips)) {
  Random random(seed, "leaf relief");
  valley_ = 0.030 * random.uniform(0.8, 1.2);
  fold_ = 0.10 * random.uniform(0.5, 1.5);
  arch_ = 0.07 * random.uniform(0.4, 1.4);
  droop_ = 0.11 * random.uniform(0.4, 1.4);
  dome_ = 0.10 * random.uniform(-0.3, 1.3);
  for (Wave& wave : waves_) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double length = random.uniform(0.28, 0.7);
    wave.vector = 2.0 * std::numbers::pi / length * Vec2(std::cos(angle), std::sin(angle));
    wave.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    wave.amplitude = 0.012 * length * random.normal();
  }
}

double Relief::operator()(const Vec2& p) const {
  constexpr double kValleyWidth = 0.13;
  constexpr double kCrease = 0.015;
  const double x = p.x(), y = p.y();
  double z = valley_ * std::tanh(vein_distance(p) / kValleyWidth);
  z += fold_ * (std::sqrt(x * x + kCrease * kCrease) - kCrease);
  z += arch_ * y - droop_ * y * y - dome_ * x * x;
  const double outwards = std::min(1.0, p.squaredNorm() / 0.09);
  for (const Wave& wave : waves_) z += outwards * wave.amplitude * std::sin(wave.vector.dot(p) + wave.phase);
  return z;
}

// The distance to the nearest main vein, smooth between veins: (sum d_i^-4)^(-1/4).
double Relief::vein_distance(const Vec2& p) const {
  constexpr double kCrease = 0.012;
  double sum = 0.0;
  for (const Vec2& tip : tips_) {
    const double t = std::clamp(p.dot(tip) / tip.squaredNorm(), 0.0, 1.0);
    const double d = std::sqrt((p - t * tip).squaredNorm() + kCrease * kCrease);
    sum += 1.0 / (d * d * d * d);
  }
  return std::pow(sum, -0.25);
}

}  // namespace wilt
