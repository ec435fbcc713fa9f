// The main veins drawn into a leaf's texture plane.
#pragma once

#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// The middle of texel (x, y), from the top left, in a texture plane of `size` texels on a side.
inline Vec2 texel_centre(int x, int y, int size) {
  return {(x + 0.5) / size, (y + 0.5) / size};
}

/// Primary and secondary veins as strokes that taper towards their tips, at least a texel wide.
class VeinStrokes {
 public:
  VeinStrokes(const Leaf& leaf, const Venation& venation, int size);

  /// The veins' rounded profiles on rows first..last: 0 beside a vein, 1 on a primary vein's axis, .8 on a
  /// secondary one's. (last - first + 1) x size.
  std::vector<float> heights(int first, int last) const;

 private:
  struct Stroke {
    Vec2 a, b;
    double radius_a, radius_b;  // in the unit of uv
    double strength;
  };
  void add(const Leaf& leaf, const Vein& vein, double blade);

  int size_;
  std::vector<Stroke> strokes_;
};

}  // namespace wilt
