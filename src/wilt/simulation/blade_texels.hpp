// The blade texel by texel, in the plane of its skin's texture coordinates.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/simulation/vein_strokes.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// What lies under the middles of the texels of one row that the blade covers, from left to right. Arrays
/// have a place for each, and zeros up to a multiple of sixteen.
struct BladeRow {
  int y = 0;
  std::vector<int> columns;
  std::vector<float> plane_x, plane_y;  ///< of the blade at rest, in leaf lengths
  std::vector<float> vein;              ///< height of the main veins' profile, VeinStrokes

  int count() const { return static_cast<int>(columns.size()); }

  /// Neighbours on one face of the skin: the corners' weights change evenly along them.
  struct Run {
    int face, begin, end;
    Vec3 weights, step;
  };
  std::vector<Run> runs;
};

/// Where the maps of a leaf are drawn: `size` x `size` texels, and which of them the blade covers.
class BladeTexels {
 public:
  /// None when `size` is 0 or the skin cannot carry a texture of its own (uv_raster.hpp). Refers to `leaf`,
  /// which must outlive it.
  static std::optional<BladeTexels> make(const Leaf& leaf, const Venation& venation, int size);

  const Leaf& leaf() const { return leaf_; }
  const UvRaster& raster() const { return raster_; }
  double length() const { return length_; }  ///< of the leaf, metres

  /// Calls visit for every row, on several threads; it may write what belongs to that row.
  void for_each_row(const std::function<void(const BladeRow&)>& visit) const;

  /// Values of the vertices (#V) at a row's texels, padded as its arrays are.
  void interpolate(const Eigen::VectorXd& values, const BladeRow& row, std::vector<float>& at_texels) const;

  /// An image with nothing drawn yet.
  Image blank() const;

 private:
  BladeTexels(const Leaf& leaf, const Venation& venation, UvRaster raster);

  BladeRow row(int y, const float* veins) const;
  int vertex(int face, int corner) const {
    return leaf_.skin.vertex[static_cast<std::size_t>(leaf_.skin.faces(face, corner))];
  }

  const Leaf& leaf_;
  double length_;
  UvRaster raster_;
  VeinStrokes strokes_;
  Eigen::VectorXd plane_x_, plane_y_;  // of the vertices
};

}  // namespace wilt
