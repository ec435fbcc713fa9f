// A picture on a surface, smooth at any distance.
#pragma once

#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/core/types.hpp"

namespace wilt {

/// The pixels of an image as numbers, with ever coarser copies (mip levels): between four pixels and two
/// levels the value is linear. Outside, the edge goes on.
class Texture {
 public:
  enum class Kind {
    colour,    ///< sRGB bytes to linear light
    direction  ///< bytes to [-1, 1]
  };

  Texture() = default;
  Texture(const Image& image, Kind kind);  ///< an empty image makes an empty texture

  bool empty() const { return levels_.empty(); }
  double size() const;  ///< geometric mean of width and height of the finest level, pixels

  /// The value at `uv` (glTF: origin top left), averaged over about `footprint` (>= 0, in units of uv). Not
  /// empty.
  Vec3 at(const Vec2& uv, double footprint) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<Eigen::Vector3f> pixels;
  };
  static Vec3 bilinear(const Level& level, const Vec2& uv);

  std::vector<Level> levels_;  // finest first
};

}  // namespace wilt
