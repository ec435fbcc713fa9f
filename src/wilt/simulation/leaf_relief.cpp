#include "wilt/simulation/leaf_relief.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/simulation/fine_network.hpp"

namespace wilt {
namespace {

// Heights in leaf lengths.
constexpr float kVein = 0.0042f, kTertiary = 0.0009f, kQuaternary = 0.00035f, kAreole = 0.00012f;
constexpr float kSunk = 0.0035f;                               // of dry tissue between tertiary veins
constexpr float kCrinkle[] = {0.0016f, 0.00075f, 0.00022f};    // of dry tissue, at three sizes
constexpr float kCrinkleFrequency[] = {30.0f, 75.0f, 190.0f};  // in a leaf's length
constexpr float kBesidePhoto = 0.3f;  // share of drawn veins where a photo shows real ones
constexpr float kFreshShare = 0.25f;  // of crinkles and sunk tissue in a fresh leaf

// A noise that creases: ridges where smooth noise changes its sign.
WILT_INLINE Float16 creases(const Place16& p, std::uint64_t seed) {
  const Float16 noise = value_noise(p, seed);
  return 1.0f - 2.0f * simd::larger(noise, -noise);
}

// 0 from 0 on, 1 from `high` on.
WILT_INLINE Float16 smooth_rise(Float16 x, float high) {
  const Float16 t = clamped(x / high, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Heights of a row's texels in leaf lengths, drawn veins by a share; `dryness` and `heights` are padded as
// the row's arrays are.
WILT_CLONES void sculpt(const BladeRow& row, std::uint64_t leaf_seed, float drawn,
                        const std::vector<float>& dryness, std::vector<float>& heights) {
  const std::uint64_t seed = mix_hash(leaf_seed, 78);
  for (int i = 0; i < row.count(); i += 2 * simd::kLanes) {
    const Place16 p{simd::load(&row.plane_x[i]), simd::load(&row.plane_y[i])};
    const FineNetwork16 network = fine_network(p, leaf_seed);
    const Float16 dry = kFreshShare + (1.0f - kFreshShare) * simd::load(&dryness[i]);
    Float16 height =
        drawn * (kTertiary * network.tertiary + kQuaternary * network.quaternary + kAreole * network.areole);
    height -= dry * kSunk * smooth_rise(network.within, 0.45f);
    for (int k = 0; k < 3; ++k)
      height +=
          dry * kCrinkle[k] *
          creases({p.x * kCrinkleFrequency[k], p.y * kCrinkleFrequency[k]}, mix_hash(seed, std::uint64_t(k)));
    // A main vein stands above what lies beside it.
    const Float16 vein = drawn * simd::load(&row.vein[i]);
    simd::store(&heights[i], (1.0f - vein) * height + vein * kVein);
  }
}

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
void add_normals(const UvRaster& raster, const std::vector<float>& heights, float scale, int y,
                 std::vector<std::uint8_t>& rgb) {
  const int size = raster.size;
  const auto difference = [&](std::size_t i, std::ptrdiff_t step, bool before, bool after) {
    const std::size_t a = before && raster.face[i - step] >= 0 ? i - step : i;
    const std::size_t b = after && raster.face[i + step] >= 0 ? i + step : i;
    const bool both = a != i && b != i;
    return (heights[b] - heights[a]) * (both ? 0.5F * scale : scale);
  };
  for (int x = 0; x < size; ++x) {
    const std::size_t i = static_cast<std::size_t>(y) * size + x;
    if (raster.face[i] < 0) continue;
    const float nx = -difference(i, 1, x > 0, x + 1 < size), ny = difference(i, size, y > 0, y + 1 < size);
    const float half = 127.5F / std::sqrt(nx * nx + ny * ny + 1.0F);
    rgb[3 * i] = static_cast<std::uint8_t>(nx * half + 128.0F);
    rgb[3 * i + 1] = static_cast<std::uint8_t>(ny * half + 128.0F);
    rgb[3 * i + 2] = static_cast<std::uint8_t>(half + 128.0F);
  }
}

}  // namespace

Image leaf_relief(const BladeTexels& texels, const Eigen::VectorXd& dryness) {
  const UvRaster& raster = texels.raster();
  std::vector<float> heights(raster.face.size());
  texels.for_each_row([&](const BladeRow& row) {
    std::vector<float> dry, high(row.vein.size());
    texels.interpolate(dryness, row, dry);
    sculpt(row, texels.leaf().seed, texels.leaf().photo ? kBesidePhoto : 1.0F, dry, high);
    float* of_row = heights.data() + static_cast<std::size_t>(row.y) * raster.size;
    for (int i = 0; i < row.count(); ++i) of_row[row.columns[i]] = high[i];
  });
  Image map = texels.blank();
  const auto scale = static_cast<float>(uv_scale(texels) * raster.size);
  parallel_for(raster.size, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) add_normals(raster, heights, scale, y, map.rgb);
  });
  bleed(raster, map.rgb);
  return map;
}

}  // namespace wilt
