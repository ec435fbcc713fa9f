// A skin's texture plane in texels: which face covers each, and how the rest is filled.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wilt/leaf/leaf.hpp"

namespace wilt {

/// The face that covers the centre of each texel, row by row from the top left; -1 where there is none.
struct UvRaster {
  int size = 0;           ///< texels on a side
  std::vector<int> face;  ///< size * size
};

/// None when the skin cannot carry a texture of its own: no texture coordinates, some outside [0, 1], or
/// faces that overlap on more than 0.1 % of their texels (copied or mirrored islands). `size` >= 1.
/// Deterministic on any number of threads. O(texels + faces).
std::optional<UvRaster> uv_raster(const Skin& skin, int size);

/// The corners' weights at a point of the texture plane in the unit of `uv`; they add up to 1.
Vec3 uv_weights(const Skin& skin, int face, const Vec2& uv);

/// Fills texels that no face covers from the nearest covered ones, level by level of an image pyramid (push
/// and pull), so that every mip level of the picture is free of the background. `rgb`: size * size * 3.
void bleed(const UvRaster& raster, std::vector<std::uint8_t>& rgb);

}  // namespace wilt
