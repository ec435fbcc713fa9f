#include "wilt/output/leaf_paint.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "wilt/core/check.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/leaf/species.hpp"
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

// What the texture's mean colours may be: brighter than the last frame's so that no frame asks for a vertex
// colour above 1, dark enough for the photo's brightest texels.
Points3 texture_level(const std::vector<Points3>& colours, const PhotoTissue& tissue) {
  const Points3 room = tissue.colour.cwiseQuotient(tissue.brightest);
  return (colours.back() * texture_gain(colours).asDiagonal()).cwiseMin(room).cwiseMax(tissue.colour);
}

// Darkens what is brighter than the texture can show; its hue stays.
void limit_colours(Points3& colours, const Points3& most) {
  for (Eigen::Index v = 0; v < colours.rows(); ++v)
    colours.row(v) *= std::min(most.row(v).cwiseQuotient(colours.row(v)).minCoeff(), 1.0);
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

// Texels on a side. A photo keeps its own, up to twice of what a drawn texture has; it is looked at even
// where no texture is asked for.
int texels_on_a_side(const Leaf& leaf, std::int64_t setting) {
  constexpr std::int64_t kUntextured = 512;
  if (!leaf.photo) return static_cast<int>(setting);
  const std::int64_t own = std::max(leaf.photo->image.width, leaf.photo->image.height);
  return static_cast<int>(std::min(own, setting > 0 ? 2 * setting : kUntextured));
}

}  // namespace

struct LeafPaint::Paint {
  Paint(const Leaf& leaf, const Venation& venation, const Config& config,
        const std::vector<Eigen::VectorXd>& states)
      : tissue(species(config.species).pigments),
        pattern(senescence_pattern(leaf, venation, species(config.species).pigments)),
        fresh_stalk(linear_rgb(species(config.species).pigments.stalk)) {
    WILT_CHECK(!states.empty(), states.size());
    const auto texels = BladeTexels::make(leaf, venation, texels_on_a_side(leaf, config.texture.size));
    if (!texels) return;
    if (leaf.photo)
      by_photo(*texels, config.texture.size > 0, states);
    else
      by_species(*texels, states);
  }

  // C of a state.
  Points3 colours(const Eigen::VectorXd& dryness) const {
    return photo ? aged_colours(*photo, pattern, tissue, dryness)
                 : leaf_colours(pattern, tissue, dryness).cwiseMax(divisor.size() > 0 ? kDarkest : 0.0);
  }

  std::vector<Points3> colours(const std::vector<Eigen::VectorXd>& states) const {
    std::vector<Points3> all;
    for (const Eigen::VectorXd& dryness : states) all.push_back(colours(dryness));
    return all;
  }

  void by_species(const BladeTexels& texels, const std::vector<Eigen::VectorXd>& states) {
    const std::vector<Points3> all = colours(states);
    const Vec3 gain = texture_gain(all);
    set_maps(leaf_texture(texels, pattern, tissue, states.back(), gain), leaf_relief(texels, states.back()));
    divisor = all.back().cwiseMax(kDarkest) * gain.asDiagonal();
  }

  void by_photo(const BladeTexels& texels, bool textured, const std::vector<Eigen::VectorXd>& states) {
    const Leaf& leaf = texels.leaf();
    const Image picture = resized(leaf.photo->image, texels.raster().size, texels.raster().size);
    photo = photo_tissue(texels, picture, pattern, tissue);
    fresh_stalk = stalk_colour(leaf, *photo);
    if (!textured) return;
    const std::vector<Points3> all = colours(states);
    divisor = texture_level(all, *photo);
    set_maps(photo_texture(texels, picture, *photo, {blade(states.front()), divisor},
                           faded_hue(pattern, states.back())),
             leaf_relief(texels, states.back()));
  }

  // Both maps at a time.
  void set_maps(const Image& colour, const Image& relief) {
    const std::array<const Image*, 2> maps{&colour, &relief};
    const std::array<std::string*, 2> encoded{&texture, &normal_texture};
    parallel_for(2, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) *encoded[k] = encode_jpeg(*maps[k]);
    });
  }

  Points3 blade(const Eigen::VectorXd& dryness) const {
    Points3 result = colours(dryness);
    if (divisor.size() == 0) return result;
    if (photo) limit_colours(result, divisor);
    return result.cwiseQuotient(divisor).cwiseMin(1.0);
  }

  TissueColours tissue;
  SenescencePattern pattern;
  Vec3 fresh_stalk;
  std::optional<PhotoTissue> photo;
  Points3 divisor;  // the texture's mean colours, #V x 3; empty: there is none
  std::string texture, normal_texture;
};

LeafPaint::LeafPaint(const Leaf& leaf, const Venation& venation, const Config& config,
                     const std::vector<Eigen::VectorXd>& states)
    : paint_(std::make_unique<Paint>(leaf, venation, config, states)) {}
LeafPaint::LeafPaint(LeafPaint&&) noexcept = default;
LeafPaint& LeafPaint::operator=(LeafPaint&&) noexcept = default;
LeafPaint::~LeafPaint() = default;

Points3 LeafPaint::blade(const Eigen::VectorXd& dryness) const {
  return paint_->blade(dryness);
}

Vec3 LeafPaint::stalk(const Eigen::VectorXd& dryness) const {
  const double dry = kStalkDries * dryness.mean();
  return (1.0 - dry) * paint_->fresh_stalk + dry * kStalkShade * paint_->tissue({1.0, 0.0, 0.0});
}

const std::string& LeafPaint::texture() const {
  return paint_->texture;
}

const std::string& LeafPaint::normal_texture() const {
  return paint_->normal_texture;
}

}  // namespace wilt
