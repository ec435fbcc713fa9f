#include "wilt/simulation/leaf_relief.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/hash.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/smooth_step.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

// Heights in leaf lengths.
constexpr double kVein = 0.0042, kTertiary = 0.0009, kQuaternary = 0.00035, kAreole = 0.00012;
constexpr double kSunk = 0.0035;                             // of dry tissue between tertiary veins
constexpr double kCrinkle[] = {0.0016, 0.00075, 0.00022};    // of dry tissue, at three sizes
constexpr double kCrinkleFrequency[] = {30.0, 75.0, 190.0};  // in a leaf's length
constexpr double kFreshShare = 0.25;                         // of crinkles and sunk tissue in a fresh leaf

// A noise that creases: ridges where smooth noise changes its sign.
double creases(const Vec2& p, std::uint64_t seed) {
  return 1.0 - 2.0 * std::abs(value_noise(p, seed).value);
}

class Sculptor {
 public:
  Sculptor(const BladeTexels& texels, const Eigen::VectorXd& dryness)
      : texels_(texels), dryness_(dryness), seed_(mix_hash(texels.leaf().seed, 78)) {}

  /// In leaf lengths.
  double height(const BladeTexel& texel) const {
    const FineNetwork& network = texel.network;
    const double dry = kFreshShare + (1.0 - kFreshShare) * texels_.interpolate(dryness_, texel);
    double height =
        kTertiary * network.tertiary + kQuaternary * network.quaternary + kAreole * network.areole;
    height -= dry * kSunk * smooth_step(0.0, 0.45, network.within);
    for (int k = 0; k < 3; ++k)
      height +=
          dry * kCrinkle[k] * creases(texel.plane * kCrinkleFrequency[k], mix_hash(seed_, std::uint64_t(k)));
    // A main vein stands above what lies beside it.
    return (1.0 - texel.vein) * height + texel.vein * kVein;
  }

 private:
  const BladeTexels& texels_;
  const Eigen::VectorXd& dryness_;
  std::uint64_t seed_;
};

// Texture lengths per leaf length.
double uv_scale(const BladeTexels& texels) {
  double uv = 0.0, metres = 0.0;
  const Leaf& leaf = texels.leaf();
  const Skin& skin = leaf.skin;
  for (int f = 0; f < skin.faces.rows(); ++f) {
    const int a = skin.faces(f, 0), b = skin.faces(f, 1);
    uv += (skin.uv.row(a) - skin.uv.row(b)).norm();
    metres += (leaf.positions.row(skin.vertex[static_cast<std::size_t>(a)]) -
               leaf.positions.row(skin.vertex[static_cast<std::size_t>(b)]))
                  .norm();
  }
  return uv / metres * texels.length();
}

// Normals of the heights on one row by central differences, one-sided beside texels without a face.
void add_normals(const UvRaster& raster, const std::vector<float>& heights, double scale, int y,
                 std::vector<std::uint8_t>& rgb) {
  const int size = raster.size;
  const auto difference = [&](std::size_t i, std::ptrdiff_t step, bool before, bool after) {
    const std::size_t a = before && raster.face[i - step] >= 0 ? i - step : i;
    const std::size_t b = after && raster.face[i + step] >= 0 ? i + step : i;
    const double steps = double(b - a) / double(step);
    return steps > 0.0 ? (heights[b] - heights[a]) * scale * size / steps : 0.0;
  };
  for (int x = 0; x < size; ++x) {
    const std::size_t i = static_cast<std::size_t>(y) * size + x;
    if (raster.face[i] < 0) continue;
    const Vec3 normal =
        Vec3(-difference(i, 1, x > 0, x + 1 < size), difference(i, size, y > 0, y + 1 < size), 1.0)
            .normalized();
    for (int c = 0; c < 3; ++c)
      rgb[3 * i + c] = static_cast<std::uint8_t>(std::lround((normal[c] + 1.0) * 127.5));
  }
}

}  // namespace

Image leaf_relief(const BladeTexels& texels, const Eigen::VectorXd& dryness) {
  const Sculptor sculptor(texels, dryness);
  const UvRaster& raster = texels.raster();
  std::vector<float> heights(raster.face.size());
  texels.for_each(
      [&](const BladeTexel& texel) { heights[texel.index] = static_cast<float>(sculptor.height(texel)); });
  Image map = texels.blank();
  const double scale = uv_scale(texels);
  parallel_for(raster.size, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) add_normals(raster, heights, scale, y, map.rgb);
  });
  bleed(raster, map.rgb);
  return map;
}

}  // namespace wilt
