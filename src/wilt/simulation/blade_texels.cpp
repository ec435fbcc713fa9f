#include "wilt/simulation/blade_texels.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that are visited by one thread

}  // namespace

std::optional<BladeTexels> BladeTexels::make(const Leaf& leaf, const Venation& venation, int size) {
  if (size == 0) return std::nullopt;
  std::optional<UvRaster> raster = uv_raster(leaf.skin, size);
  if (!raster) return std::nullopt;
  return BladeTexels(leaf, venation, std::move(*raster));
}

BladeTexels::BladeTexels(const Leaf& leaf, const Venation& venation, UvRaster raster)
    : leaf_(leaf),
      length_(leaf_length(leaf)),
      raster_(std::move(raster)),
      strokes_(leaf, venation, raster_.size) {}

void BladeTexels::for_each(const std::function<void(const BladeTexel&)>& visit) const {
  parallel_for((raster_.size + kBand - 1) / kBand, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band)
      visit_rows(band * kBand, std::min(raster_.size, (band + 1) * kBand) - 1, visit);
  });
}

void BladeTexels::visit_rows(int first, int last, const std::function<void(const BladeTexel&)>& visit) const {
  const std::vector<float> veins = strokes_.heights(first, last);
  BladeTexel texel;
  for (int y = first; y <= last; ++y) {
    for (int x = 0; x < raster_.size; ++x) {
      texel.index = static_cast<std::size_t>(y) * raster_.size + x;
      texel.face = raster_.face[texel.index];
      if (texel.face < 0) continue;
      texel.weights = uv_weights(leaf_.skin, texel.face, texel_centre(x, y, raster_.size));
      texel.plane = Vec2::Zero();
      for (int c = 0; c < 3; ++c) {
        const int v = leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(texel.face, c))];
        texel.plane += texel.weights[c] * leaf_.positions.row(v).head<2>().transpose() / length_;
      }
      texel.vein = veins[static_cast<std::size_t>(y - first) * raster_.size + x];
      texel.network = fine_network(texel.plane, leaf_.seed);
      visit(texel);
    }
  }
}

double BladeTexels::interpolate(const Eigen::VectorXd& values, const BladeTexel& texel) const {
  double value = 0.0;
  for (int c = 0; c < 3; ++c)
    value += texel.weights[c] *
             values[leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(texel.face, c))]];
  return value;
}

Image BladeTexels::blank() const {
  const int size = raster_.size;
  return {size, size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
}

}  // namespace wilt
