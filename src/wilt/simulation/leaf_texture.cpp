#include "wilt/simulation/leaf_texture.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/srgb.hpp"
#include "wilt/simulation/fine_network.hpp"

namespace wilt {
namespace {

// exp(-x^2) to 0.04, 0 from 2.8 on.
WILT_INLINE Float16 bell(Float16 x) {
  const Float16 a = simd::larger(1.0f - 0.125f * x * x, Float16{});
  const Float16 b = a * a, c = b * b;
  return c * c;
}

// A necrotic spot at `p` (leaf lengths): 1 inside, 0 outside; the older the tissue, the more there are.
WILT_INLINE Float16 spot(const Place16& p, Float16 age, std::uint64_t seed) {
  constexpr float kCells = 34.0f, kMost = 0.16f;
  const Place16 q{p.x * kCells, p.y * kCells};
  const Int16 i = floor_of(q.x), j = floor_of(q.y);
  const Float16 x = q.x - __builtin_convertvector(i, Float16), y = q.y - __builtin_convertvector(j, Float16);
  const Word16 which = Lattice16(i, j, seed).word(0, 0), how = Lattice16(i, j, mix_hash(seed, 1)).word(0, 0);
  const Float16 from_x = x - (0.3f + 0.4f * unit(how, 0)), from_y = y - (0.3f + 0.4f * unit(how, 16));
  const Float16 size = unit(which, 0), radius = 0.06f + 0.2f * size * size * size;
  const Float16 ragged = 1.0f + 0.35f * value_noise({p.x * 260.0f, p.y * 260.0f}, seed);
  const Float16 depth =
      clamped(2.5f * (1.0f - simd::sqrt(from_x * from_x + from_y * from_y) / (radius * ragged)), 0.0f, 1.0f);
  const Int16 is_here = unit(which, 16) <= kMost * simd::smaller(age, Float16{} + 1.0f);
  return is_here ? depth : Float16{};
}

/// What the tissue under a row's texels is like; every array is padded as those of the row are.
struct RowTissue {
  std::vector<float> dryness, ahead, redness, margin;  // margin distance in leaf lengths
  std::vector<float> age, vein, shade;                 // shade multiplies the colour
};

// Age, redness, vein and shade with the detail that is finer than a mesh.
WILT_CLONES void add_detail(const BladeRow& row, std::uint64_t leaf_seed, RowTissue& tissue) {
  const std::uint64_t seed = mix_hash(leaf_seed, 77);
  for (int i = 0; i < row.count(); i += 2 * simd::kLanes) {
    const Place16 p{simd::load(&row.plane_x[i]), simd::load(&row.plane_y[i])};
    const auto noise = [&](float frequency, std::uint64_t purpose) __attribute__((always_inline)) {
      return value_noise({p.x * frequency, p.y * frequency}, mix_hash(seed, purpose));
    };
    const FineNetwork16 network = fine_network(p, leaf_seed);
    const Float16 fine =
        simd::larger(network.tertiary, simd::larger(0.6f * network.quaternary, 0.3f * network.areole));
    const Float16 blotch = noise(13.0f, 1), mottle = noise(47.0f, 2), grain = noise(210.0f, 3);
    const Float16 dryness = simd::load(&tissue.dryness[i]);
    const Float16 rim = bell(simd::load(&tissue.margin[i]) / 0.006f);
    Float16 age = clamped(dryness * (1.0f + simd::load(&tissue.ahead[i])), 0.0f, kOldestTissue) +
                  dryness * (0.07f * blotch + 0.06f * mottle + 0.03f * grain - 0.035f * fine + 0.30f * rim);
    age += (1.38f - age) * 0.8f * spot(p, age, mix_hash(seed, 4));
    simd::store(&tissue.age[i], age);
    simd::store(&tissue.redness[i], simd::load(&tissue.redness[i]) + 0.25f * mottle + 0.1f * blotch);
    simd::store(&tissue.vein[i], simd::larger(simd::load(&row.vein[i]), 0.28f * fine));
    simd::store(&tissue.shade[i], 1.0f + 0.05f * mottle + 0.05f * grain + 0.03f * blotch);
  }
}

class Painter {
 public:
  Painter(const BladeTexels& texels, const SenescencePattern& pattern, const TissueColours& colours,
          const Eigen::VectorXd& dryness, const Vec3& gain)
      : texels_(texels),
        pattern_(pattern),
        margin_distance_(pattern.margin_distance / texels.length()),
        colours_(colours),
        dryness_(dryness),
        gain_(gain) {}

  void paint(const BladeRow& row, std::vector<std::uint8_t>& rgb) const {
    RowTissue tissue;
    texels_.interpolate(dryness_, row, tissue.dryness);
    texels_.interpolate(pattern_.ahead, row, tissue.ahead);
    texels_.interpolate(pattern_.redness, row, tissue.redness);
    texels_.interpolate(margin_distance_, row, tissue.margin);
    for (auto* values : {&tissue.age, &tissue.vein, &tissue.shade}) values->resize(tissue.dryness.size());
    add_detail(row, texels_.leaf().seed, tissue);
    std::uint8_t* bytes = rgb.data() + 3 * static_cast<std::size_t>(row.y) * texels_.raster().size;
    for (int i = 0; i < row.count(); ++i) {
      const Vec3 linear =
          tissue.shade[i] * colours_({tissue.age[i], tissue.redness[i], tissue.vein[i]}).cwiseProduct(gain_);
      for (int c = 0; c < 3; ++c) bytes[3 * row.columns[i] + c] = encode_(linear[c]);
    }
  }

 private:
  const BladeTexels& texels_;
  const SenescencePattern& pattern_;
  Eigen::VectorXd margin_distance_;  // in leaf lengths
  const TissueColours& colours_;
  const Eigen::VectorXd& dryness_;
  Vec3 gain_;
  SrgbBytes encode_;
};

}  // namespace

Image leaf_texture(const BladeTexels& texels, const SenescencePattern& pattern, const TissueColours& colours,
                   const Eigen::VectorXd& dryness, const Vec3& gain) {
  const Painter painter(texels, pattern, colours, dryness, gain);
  Image texture = texels.blank();
  texels.for_each_row([&](const BladeRow& row) { painter.paint(row, texture.rgb); });
  bleed(texels.raster(), texture.rgb);
  return texture;
}

}  // namespace wilt
