#include "wilt/simulation/smooth_noise.hpp"

#include <cmath>
#include <numbers>

#include "wilt/core/random.hpp"

namespace wilt {
namespace {

constexpr int kWaves = 32;

}  // namespace

Eigen::VectorXd smooth_noise(const Points2& points, double wavelength, std::uint64_t seed,
                             std::string_view purpose) {
  Random random(seed, purpose);
  Eigen::VectorXd field = Eigen::VectorXd::Zero(points.rows());
  for (int wave = 0; wave < kWaves; ++wave) {
    const double direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double number = 2.0 * std::numbers::pi / (wavelength * random.uniform(0.8, 1.3));
    const Vec2 k(number * std::cos(direction), number * std::sin(direction));
    field.array() += (points * k).array().unaryExpr([&](double angle) { return std::cos(angle + phase); });
  }
  return field * std::sqrt(2.0 / kWaves);  // a cosine of random phase has variance 1/2
}

}  // namespace wilt
