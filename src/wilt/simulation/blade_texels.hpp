// The blade texel by texel, in the plane of its skin's texture coordinates.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "wilt/core/image.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/uv_raster.hpp"
#include "wilt/simulation/vein_strokes.hpp"
#include "wilt/venation/fine_network.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// What lies under the middle of a texel.
struct BladeTexel {
  std::size_t index = 0;  ///< row by row from the top left
  int face = 0;           ///< of the skin
  Vec3 weights;           ///< of the face's corners
  Vec2 plane;             ///< x and y of the blade at rest, in leaf lengths
  double vein = 0.0;      ///< height of the main veins' profile, VeinStrokes
  FineNetwork network;
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

  /// Calls visit for every covered texel, on several threads; it may write what belongs to that texel.
  void for_each(const std::function<void(const BladeTexel&)>& visit) const;

  /// A value of the vertices (#V) at a texel.
  double interpolate(const Eigen::VectorXd& values, const BladeTexel& texel) const;

  /// An image with nothing drawn yet.
  Image blank() const;

 private:
  BladeTexels(const Leaf& leaf, const Venation& venation, UvRaster raster);

  void visit_rows(int first, int last, const std::function<void(const BladeTexel&)>& visit) const;

  const Leaf& leaf_;
  double length_;
  UvRaster raster_;
  VeinStrokes strokes_;
};

}  // namespace wilt
