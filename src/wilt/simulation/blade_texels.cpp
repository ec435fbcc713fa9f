#include "wilt/simulation/blade_texels.hpp"

#include <algorithm>
#include <utility>

#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;   // rows that are visited by one thread
constexpr int kGroup = 16;  // texels that are painted at a time

std::size_t padded(int count) {
  return static_cast<std::size_t>((count + kGroup - 1) / kGroup * kGroup);
}

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
      strokes_(leaf, venation, raster_.size),
      plane_x_(leaf.positions.col(0) / length_),
      plane_y_(leaf.positions.col(1) / length_) {}

void BladeTexels::for_each_row(const std::function<void(const BladeRow&)>& visit) const {
  parallel_for((raster_.size + kBand - 1) / kBand, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band) {
      const int first = band * kBand, last = std::min(raster_.size, first + kBand) - 1;
      const std::vector<float> veins = strokes_.heights(first, last);
      for (int y = first; y <= last; ++y)
        visit(row(y, veins.data() + static_cast<std::size_t>(y - first) * raster_.size));
    }
  });
}

BladeRow BladeTexels::row(int y, const float* veins) const {
  BladeRow row;
  row.y = y;
  const int* faces = raster_.face.data() + static_cast<std::size_t>(y) * raster_.size;
  for (int x = 0; x < raster_.size;) {
    const int first = x, face = faces[first];
    while (x < raster_.size && faces[x] == face) ++x;
    if (face < 0) continue;
    const Vec3 weights = uv_weights(leaf_.skin, face, texel_centre(first, y, raster_.size));
    const Vec3 next = uv_weights(leaf_.skin, face, texel_centre(first + 1, y, raster_.size));
    row.runs.push_back({face, row.count(), row.count() + x - first, weights, next - weights});
    for (int column = first; column < x; ++column) row.columns.push_back(column);
  }
  interpolate(plane_x_, row, row.plane_x);
  interpolate(plane_y_, row, row.plane_y);
  row.vein.assign(padded(row.count()), 0.0F);
  for (int i = 0; i < row.count(); ++i) row.vein[i] = veins[row.columns[i]];
  return row;
}

void BladeTexels::interpolate(const Eigen::VectorXd& values, const BladeRow& row,
                              std::vector<float>& at_texels) const {
  at_texels.assign(padded(row.count()), 0.0F);
  for (const BladeRow::Run& run : row.runs) {
    const Vec3 corners(values[vertex(run.face, 0)], values[vertex(run.face, 1)], values[vertex(run.face, 2)]);
    const double first = run.weights.dot(corners), step = run.step.dot(corners);
    for (int i = run.begin; i < run.end; ++i)
      at_texels[i] = static_cast<float>(first + (i - run.begin) * step);
  }
}

Image BladeTexels::blank() const {
  const int size = raster_.size;
  return {size, size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size) * size)};
}

}  // namespace wilt
