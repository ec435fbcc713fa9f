#include <algorithm>
#include <array>

#include "wilt/core/image_codec.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/leaf_relief.hpp"
#include "wilt/simulation/leaf_texture.hpp"
#include "wilt/simulation/senescence.hpp"

namespace wilt {
namespace {

constexpr double kStalkDries = 0.7;  // share of dead tissue's colour in the stalk of a dry leaf
constexpr double kStalkShade = 0.6;  // and that darker than the blade's
constexpr double kDarkest = 0.004;   // colours that are divided by are kept above it

// What the texture is brighter than the last frame by, so that no earlier frame asks for a vertex colour
// above 1; limited by the brightest place of the last frame, which the texture must hold.
Vec3 texture_gain(const std::vector<Points3>& colours) {
  const Points3 last = colours.back().cwiseMax(kDarkest);
  Vec3 gain = Vec3::Ones();
  for (const Points3& frame : colours)
    gain = gain.cwiseMax(frame.cwiseQuotient(last).colwise().maxCoeff().transpose());
  const Vec3 room = 0.9 * last.colwise().maxCoeff().transpose().cwiseInverse();
  return gain.cwiseMin(room).cwiseMax(1.0);
}

}  // namespace

Clip make_clip(const Leaf& leaf, const Venation& venation, const Config& config,
               const std::vector<Frame>& frames) {
  const Pigmentation& pigments = species(config.species).pigments;
  Clip clip{leaf, frames};
  clip.venation = &venation;
  clip.config = to_json(config);
  const TissueColours tissue(pigments);
  const SenescencePattern pattern = senescence_pattern(leaf, venation, pigments);
  const Vec3 dead = tissue({1.0, 0.0, 0.0});
  for (const Frame& frame : frames) {
    clip.colours.push_back(leaf_colours(pattern, tissue, frame.dryness));
    const double dry = kStalkDries * frame.dryness.mean();
    clip.stalk_colours.push_back((1.0 - dry) * linear_rgb(pigments.stalk) + dry * kStalkShade * dead);
  }
  const Vec3 gain = texture_gain(clip.colours);
  const auto texels = BladeTexels::make(leaf, venation, static_cast<int>(config.texture.size));
  if (!texels) return clip;
  const Eigen::VectorXd& dryness = frames.back().dryness;
  const std::array<Image, 2> maps{leaf_texture(*texels, pattern, tissue, dryness, gain),
                                  leaf_relief(*texels, dryness)};
  const std::array<std::string*, 2> encoded{&clip.texture, &clip.normal_texture};
  parallel_for(2, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) *encoded[k] = encode_jpeg(maps[k]);
  });
  const Points3 shown = clip.colours.back().cwiseMax(kDarkest) * gain.asDiagonal();
  for (Points3& frame : clip.colours) frame = frame.cwiseMax(kDarkest).cwiseQuotient(shown).cwiseMin(1.0);
  return clip;
}

}  // namespace wilt
