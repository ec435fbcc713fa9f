#include "wilt/simulation/leaf_texture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/hash.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/simulation/vein_strokes.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that are painted by one thread

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
  Painter(const Leaf& leaf, const Venation& venation, const SenescencePattern& pattern,
          const TissueColours& colours, const Eigen::VectorXd& dryness, const Vec3& gain,
          const UvRaster& raster)
      : leaf_(leaf),
        pattern_(pattern),
        dryness_(dryness),
        gain_(gain),
        raster_(raster),
        colours_(colours),
        length_(leaf_length(leaf)),
        seed_(mix_hash(leaf.seed, 77)),
        strokes_(leaf, venation, raster.size) {}

  void paint(int first, int last, std::vector<std::uint8_t>& rgb) const {
    const std::vector<float> veins = strokes_.heights(first, last);
    for (int y = first; y <= last; ++y) {
      for (int x = 0; x < raster_.size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * raster_.size + x;
        if (raster_.face[i] < 0) continue;
        const double vein = veins[static_cast<std::size_t>(y - first) * raster_.size + x];
        const Vec3 linear =
            colour(raster_.face[i], texel_centre(x, y, raster_.size), vein).cwiseProduct(gain_);
        for (int c = 0; c < 3; ++c)
          rgb[3 * i + c] =
              static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(std::clamp(linear[c], 0.0, 1.0))));
      }
    }
  }

 private:
  // The blade's colour at a point of a face whose main veins have height `vein` there.
  Vec3 colour(int face, const Vec2& uv, double vein) const {
    const Vec3 weights = uv_weights(leaf_.skin, face, uv);
    Vec2 p = Vec2::Zero();
    double dryness = 0.0, ahead = 0.0, redness = 0.0, margin = 0.0;
    for (int c = 0; c < 3; ++c) {
      const int v = leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(face, c))];
      p += weights[c] * leaf_.positions.row(v).head<2>().transpose() / length_;
      dryness += weights[c] * dryness_[v];
      ahead += weights[c] * pattern_.ahead[v];
      redness += weights[c] * pattern_.redness[v];
      margin += weights[c] * pattern_.margin_distance[v] / length_;
    }
    const FineNetwork network = fine_network(p, leaf_.seed);
    const auto noise = [&](double frequency, std::uint64_t purpose) {
      return value_noise(p * frequency, mix_hash(seed_, purpose)).value;
    };
    const double blotch = noise(13.0, 1), mottle = noise(47.0, 2), grain = noise(210.0, 3);
    const double fine = std::max({network.tertiary, 0.6 * network.quaternary, 0.3 * network.areole});
    const double rim = std::exp(-std::pow(margin / 0.006, 2.0));
    TissueState state;
    state.age = tissue_age(dryness, ahead) +
                dryness * (0.07 * blotch + 0.06 * mottle + 0.03 * grain - 0.035 * fine + 0.30 * rim);
    state.age += (1.38 - state.age) * 0.8 * spot(p, state.age, mix_hash(seed_, 4));
    state.redness = redness + 0.25 * mottle + 0.1 * blotch;
    state.vein = std::max(vein, 0.28 * fine);
    return (1.0 + 0.05 * mottle + 0.05 * grain + 0.03 * blotch) * colours_(state);
  }

  const Leaf& leaf_;
  const SenescencePattern& pattern_;
  const Eigen::VectorXd& dryness_;
  Vec3 gain_;
  const UvRaster& raster_;
  const TissueColours& colours_;
  double length_;
  std::uint64_t seed_;
  VeinStrokes strokes_;
};

}  // namespace

Image leaf_texture(const Leaf& leaf, const Venation& venation, const SenescencePattern& pattern,
                   const TissueColours& colours, const Eigen::VectorXd& dryness, const Vec3& gain, int size) {
  if (size == 0) return {};
  const std::optional<UvRaster> raster = uv_raster(leaf.skin, size);
  if (!raster) return {};
  const Painter painter(leaf, venation, pattern, colours, dryness, gain, *raster);
  Image texture{size, size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
  parallel_for((size + kBand - 1) / kBand, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band)
      painter.paint(band * kBand, std::min(size, (band + 1) * kBand) - 1, texture.rgb);
  });
  bleed(*raster, texture.rgb);
  return texture;
}

}  // namespace wilt
