#include "wilt/simulation/smooth_noise.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "wilt/core/parallel.hpp"
#include "wilt/core/random.hpp"

namespace wilt {
namespace {

constexpr int kWaves = 32;

}  // namespace

Eigen::VectorXd smooth_noise(const Points2& points, double wavelength, std::uint64_t seed,
                             std::string_view purpose) {
  struct Wave {
    Vec2 vector;
    double phase;
  };
  Random random(seed, purpose);
  std::array<Wave, kWaves> waves;
  for (Wave& wave : waves) {
    const double direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    wave.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double number = 2.0 * std::numbers::pi / (wavelength * random.uniform(0.8, 1.3));
    wave.vector = {number * std::cos(direction), number * std::sin(direction)};
  }
  Eigen::VectorXd field(points.rows());
  parallel_for(static_cast<int>(points.rows()), 256, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      double sum = 0.0;
      for (const Wave& wave : waves) sum += std::cos(points.row(v).dot(wave.vector) + wave.phase);
      field[v] = sum * std::sqrt(2.0 / kWaves);  // a cosine of random phase has variance 1/2
    }
  });
  return field;
}

}  // namespace wilt
