#include "wilt/render/detail.hpp"

#include <algorithm>

#include "wilt/core/hash.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {

double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

FineDetail fine_detail(const Vec2& p, std::uint64_t seed) {
  const FineNetwork network = fine_network(p, seed);
  const Noise crinkle = value_noise(p * 42.0, mix_hash(seed, 5)),
              grain = value_noise(p * 160.0, mix_hash(seed, 6));
  FineDetail detail;
  detail.vein = std::max(network.tertiary, 0.6 * network.quaternary);
  detail.slope = network.slope + 0.09 * crinkle.gradient + 0.05 * grain.gradient;
  detail.tone =
      0.6 * value_noise(p * 7.0, mix_hash(seed, 7)).value + 0.3 * crinkle.value + 0.25 * grain.value;
  return detail;
}

}  // namespace wilt
