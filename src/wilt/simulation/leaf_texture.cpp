#include "wilt/simulation/leaf_texture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/hash.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

// A necrotic spot at `p` (leaf lengths): 1 inside, 0 outside; the older the tissue, the more there are.
double spot(const Vec2& p, double age, std::uint64_t seed) {
  constexpr double kCells = 34.0, kMost = 0.16;
  const Vec2 q = p * kCells;
  const double i = std::floor(q.x()), j = std::floor(q.y());
  const std::uint64_t hash = mix_hash(mix_hash(seed, static_cast<std::uint64_t>(std::int64_t(i))),
                                      static_cast<std::uint64_t>(std::int64_t(j)));
  if (hash_uniform(hash) > kMost * std::min(age, 1.0)) return 0.0;
  const Vec2 centre(i + 0.3 + 0.4 * hash_uniform(mix_hash(hash, 1)),
                    j + 0.3 + 0.4 * hash_uniform(mix_hash(hash, 2)));
  const double size = hash_uniform(mix_hash(hash, 3)), radius = 0.06 + 0.2 * size * size * size;
  const double ragged = 1.0 + 0.35 * value_noise(p * 260.0, seed).value;
  return std::clamp(2.5 * (1.0 - (q - centre).norm() / (radius * ragged)), 0.0, 1.0);
}

class Painter {
 public:
  Painter(const BladeTexels& texels, const SenescencePattern& pattern, const TissueColours& colours,
          const Eigen::VectorXd& dryness, const Vec3& gain)
      : texels_(texels),
        pattern_(pattern),
        colours_(colours),
        dryness_(dryness),
        gain_(gain),
        seed_(mix_hash(texels.leaf().seed, 77)) {}

  void paint(const BladeTexel& texel, std::vector<std::uint8_t>& rgb) const {
    const Vec3 linear = colour(texel).cwiseProduct(gain_);
    for (int c = 0; c < 3; ++c)
      rgb[3 * texel.index + c] =
          static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(std::clamp(linear[c], 0.0, 1.0))));
  }

 private:
  Vec3 colour(const BladeTexel& texel) const {
    const Vec2& p = texel.plane;
    const double dryness = texels_.interpolate(dryness_, texel);
    const double margin = texels_.interpolate(pattern_.margin_distance, texel) / texels_.length();
    const FineNetwork& network = texel.network;
    const auto noise = [&](double frequency, std::uint64_t purpose) {
      return value_noise(p * frequency, mix_hash(seed_, purpose)).value;
    };
    const double blotch = noise(13.0, 1), mottle = noise(47.0, 2), grain = noise(210.0, 3);
    const double fine = std::max({network.tertiary, 0.6 * network.quaternary, 0.3 * network.areole});
    const double rim = std::exp(-std::pow(margin / 0.006, 2.0));
    TissueState state;
    state.age = tissue_age(dryness, texels_.interpolate(pattern_.ahead, texel)) +
                dryness * (0.07 * blotch + 0.06 * mottle + 0.03 * grain - 0.035 * fine + 0.30 * rim);
    state.age += (1.38 - state.age) * 0.8 * spot(p, state.age, mix_hash(seed_, 4));
    state.redness = texels_.interpolate(pattern_.redness, texel) + 0.25 * mottle + 0.1 * blotch;
    state.vein = std::max(texel.vein, 0.28 * fine);
    return (1.0 + 0.05 * mottle + 0.05 * grain + 0.03 * blotch) * colours_(state);
  }

  const BladeTexels& texels_;
  const SenescencePattern& pattern_;
  const TissueColours& colours_;
  const Eigen::VectorXd& dryness_;
  Vec3 gain_;
  std::uint64_t seed_;
};

}  // namespace

Image leaf_texture(const BladeTexels& texels, const SenescencePattern& pattern, const TissueColours& colours,
                   const Eigen::VectorXd& dryness, const Vec3& gain) {
  const Painter painter(texels, pattern, colours, dryness, gain);
  Image texture = texels.blank();
  texels.for_each([&](const BladeTexel& texel) { painter.paint(texel, texture.rgb); });
  bleed(texels.raster(), texture.rgb);
  return texture;
}

}  // namespace wilt
