#include "wilt/simulation/leaf_relief.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/hash.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/smooth_step.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/simulation/vein_strokes.hpp"
#include "wilt/venation/fine_network.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that are made by one thread

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
  Sculptor(const Leaf& leaf, const Venation& venation, const Eigen::VectorXd& dryness, const UvRaster& raster)
      : leaf_(leaf),
        dryness_(dryness),
        raster_(raster),
        length_(leaf_length(leaf)),
        seed_(mix_hash(leaf.seed, 78)),
        strokes_(leaf, venation, raster.size) {}

  /// Heights in leaf lengths on rows first..last, of texels that a face covers.
  void heights(int first, int last, std::vector<float>& all) const {
    const std::vector<float> veins = strokes_.heights(first, last);
    for (int y = first; y <= last; ++y) {
      for (int x = 0; x < raster_.size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * raster_.size + x;
        if (raster_.face[i] < 0) continue;
        const double vein = veins[static_cast<std::size_t>(y - first) * raster_.size + x];
        all[i] = static_cast<float>(height(raster_.face[i], texel_centre(x, y, raster_.size), vein));
      }
    }
  }

  /// Texture lengths per leaf length.
  double scale() const {
    double uv = 0.0, metres = 0.0;
    const Skin& skin = leaf_.skin;
    for (int f = 0; f < skin.faces.rows(); ++f) {
      const int a = skin.faces(f, 0), b = skin.faces(f, 1);
      uv += (skin.uv.row(a) - skin.uv.row(b)).norm();
      metres += (leaf_.positions.row(skin.vertex[static_cast<std::size_t>(a)]) -
                 leaf_.positions.row(skin.vertex[static_cast<std::size_t>(b)]))
                    .norm();
    }
    return uv / metres * length_;
  }

 private:
  double height(int face, const Vec2& uv, double vein) const {
    const Vec3 weights = uv_weights(leaf_.skin, face, uv);
    Vec2 p = Vec2::Zero();
    double dryness = 0.0;
    for (int c = 0; c < 3; ++c) {
      const int v = leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(face, c))];
      p += weights[c] * leaf_.positions.row(v).head<2>().transpose() / length_;
      dryness += weights[c] * dryness_[v];
    }
    const FineNetwork network = fine_network(p, leaf_.seed);
    const double dry = kFreshShare + (1.0 - kFreshShare) * dryness;
    double height =
        kTertiary * network.tertiary + kQuaternary * network.quaternary + kAreole * network.areole;
    height -= dry * kSunk * smooth_step(0.0, 0.45, network.within);
    for (int k = 0; k < 3; ++k)
      height += dry * kCrinkle[k] * creases(p * kCrinkleFrequency[k], mix_hash(seed_, std::uint64_t(k)));
    // A main vein stands above what lies beside it.
    return (1.0 - vein) * height + vein * kVein;
  }

  const Leaf& leaf_;
  const Eigen::VectorXd& dryness_;
  const UvRaster& raster_;
  double length_;
  std::uint64_t seed_;
  VeinStrokes strokes_;
};

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

Image leaf_relief(const Leaf& leaf, const Venation& venation, const Eigen::VectorXd& dryness, int size) {
  if (size == 0) return {};
  const std::optional<UvRaster> raster = uv_raster(leaf.skin, size);
  if (!raster) return {};
  const Sculptor sculptor(leaf, venation, dryness, *raster);
  std::vector<float> heights(static_cast<std::size_t>(size) * size);
  parallel_for((size + kBand - 1) / kBand, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band)
      sculptor.heights(band * kBand, std::min(size, (band + 1) * kBand) - 1, heights);
  });
  Image map{size, size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
  const double scale = sculptor.scale();
  parallel_for(size, kBand, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) add_normals(*raster, heights, scale, y, map.rgb);
  });
  bleed(*raster, map.rgb);
  return map;
}

}  // namespace wilt
