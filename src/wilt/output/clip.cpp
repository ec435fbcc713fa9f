#include <algorithm>
#include <array>
#include <optional>

#include "wilt/core/image_codec.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/leaf_relief.hpp"
#include "wilt/simulation/leaf_texture.hpp"
#include "wilt/simulation/photo_tissue.hpp"
#include "wilt/simulation/senescence.hpp"

namespace wilt {
namespace {

constexpr double kStalkDries = 0.7;   // share of dead tissue's colour in the stalk of a dry leaf
constexpr double kStalkShade = 0.6;   // and that darker than the blade's
constexpr double kStalkSight = 0.04;  // leaf lengths around the petiole where a photo shows its colour
constexpr double kDarkest = 0.004;    // colours that are divided by are kept above it

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

/// What the two ways to colour a clip share.
struct Palette {
  Palette(const Leaf& leaf, const Venation& venation, const Pigmentation& pigments)
      : tissue(pigments), pattern(senescence_pattern(leaf, venation, pigments)) {}

  TissueColours tissue;
  SenescencePattern pattern;
};

// Both maps at a time.
void set_maps(Clip& clip, const Image& colour, const Image& relief) {
  const std::array<const Image*, 2> maps{&colour, &relief};
  const std::array<std::string*, 2> encoded{&clip.texture, &clip.normal_texture};
  parallel_for(2, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) *encoded[k] = encode_jpeg(*maps[k]);
  });
}

// COLOR_0 by frame: what the texture, whose mean colours are `shown`, is multiplied by.
void divide_colours(std::vector<Points3>& colours, const Points3& shown) {
  for (Points3& frame : colours) frame = frame.cwiseQuotient(shown).cwiseMin(1.0);
}

void colour_by_species(const Palette& palette, const std::optional<BladeTexels>& texels, Clip& clip) {
  for (const Frame& frame : clip.frames)
    clip.colours.push_back(leaf_colours(palette.pattern, palette.tissue, frame.dryness));
  if (!texels) return;
  const Vec3 gain = texture_gain(clip.colours);
  const Eigen::VectorXd& dryness = clip.frames.back().dryness;
  set_maps(clip, leaf_texture(*texels, palette.pattern, palette.tissue, dryness, gain),
           leaf_relief(*texels, dryness));
  for (Points3& frame : clip.colours) frame = frame.cwiseMax(kDarkest);
  divide_colours(clip.colours, clip.colours.back() * gain.asDiagonal());
}

// What the texture's mean colours may be: brighter than the last frame's so that no frame asks for a vertex
// colour above 1, dark enough for the photo's brightest texels.
Points3 texture_level(const std::vector<Points3>& colours, const PhotoTissue& tissue) {
  const Points3 room = tissue.colour.cwiseQuotient(tissue.brightest);
  return (colours.back() * texture_gain(colours).asDiagonal()).cwiseMin(room).cwiseMax(tissue.colour);
}

// Darkens what is brighter than the texture can show; its hue stays.
void limit_colours(std::vector<Points3>& colours, const Points3& most) {
  for (Points3& frame : colours) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v)
      frame.row(v) *= std::min(most.row(v).cwiseQuotient(frame.row(v)).minCoeff(), 1.0);
  }
}

// The photo's colour where the stalk begins.
Vec3 stalk_colour(const Leaf& leaf, const PhotoTissue& tissue) {
  const double reach = kStalkSight * leaf_length(leaf);
  const Eigen::RowVector3d petiole = leaf.positions.row(leaf.petiole);
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (Eigen::Index v = 0; v < leaf.positions.rows(); ++v) {
    if ((leaf.positions.row(v) - petiole).norm() > reach) continue;
    sum += tissue.colour.row(v).transpose();
    ++count;
  }
  return sum / count;  // the petiole itself is one of them
}

/// The stalk's colour in the fresh leaf.
Vec3 colour_by_photo(const Palette& palette, const BladeTexels& texels, bool textured, Clip& clip) {
  const Image photo = resized(clip.leaf.photo->image, texels.raster().size, texels.raster().size);
  const PhotoTissue tissue = photo_tissue(texels, photo, palette.pattern, palette.tissue);
  for (const Frame& frame : clip.frames)
    clip.colours.push_back(aged_colours(tissue, palette.pattern, palette.tissue, frame.dryness));
  const Vec3 stalk = stalk_colour(clip.leaf, tissue);
  if (!textured) return stalk;
  const Points3 level = texture_level(clip.colours, tissue);
  limit_colours(clip.colours, level);
  divide_colours(clip.colours, level);
  const Eigen::VectorXd& dryness = clip.frames.back().dryness;
  set_maps(clip,
           photo_texture(texels, photo, tissue, {clip.colours.front(), level},
                         faded_hue(palette.pattern, dryness)),
           leaf_relief(texels, dryness));
  return stalk;
}

// Texels on a side. A photo keeps its own, up to twice of what a drawn texture has; it is looked at even
// where no texture is asked for.
int texels_on_a_side(const Leaf& leaf, std::int64_t setting) {
  constexpr std::int64_t kUntextured = 512;
  if (!leaf.photo) return static_cast<int>(setting);
  const std::int64_t own = std::max(leaf.photo->image.width, leaf.photo->image.height);
  return static_cast<int>(std::min(own, setting > 0 ? 2 * setting : kUntextured));
}

}  // namespace

Clip make_clip(const Leaf& leaf, const Venation& venation, const Config& config,
               const std::vector<Frame>& frames) {
  const Pigmentation& pigments = species(config.species).pigments;
  Clip clip{leaf, frames};
  clip.venation = &venation;
  clip.config = to_json(config);
  const Palette palette(leaf, venation, pigments);
  const auto texels = BladeTexels::make(leaf, venation, texels_on_a_side(leaf, config.texture.size));
  Vec3 fresh = linear_rgb(pigments.stalk);
  if (leaf.photo && texels) {
    fresh = colour_by_photo(palette, *texels, config.texture.size > 0, clip);
  } else {
    colour_by_species(palette, texels, clip);
  }
  const Vec3 dead = palette.tissue({1.0, 0.0, 0.0});
  for (const Frame& frame : frames) {
    const double dry = kStalkDries * frame.dryness.mean();
    clip.stalk_colours.push_back((1.0 - dry) * fresh + dry * kStalkShade * dead);
  }
  return clip;
}

}  // namespace wilt
