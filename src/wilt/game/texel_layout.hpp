// Where the vertices of every frame stand in a vertex-animation texture.
#pragma once

#include "wilt/core/types.hpp"

namespace wilt {

/// Vertex i of frame k is texel (i % width, k * rows_per_frame + i / width), rows counted from the top. Sides
/// are powers of two, 8192 at most, as all engines take them.
struct TexelLayout {
  int vertices = 0, frames = 0;
  int width = 0, height = 0, rows_per_frame = 0;

  /// Throws Error{configuration} when there is not enough room, with what would fit.
  static TexelLayout make(int vertices, int frames);

  int texel(int vertex, int frame) const { return frame * rows_per_frame * width + vertex; }

  /// Texture coordinates of the centres of the texels of frame 0 for vertices [first, first + count), #count
  /// x 2, origin top left as in glTF. Frame k stands k * rows_per_frame / height below.
  Points2 lookup(int first, int count) const;
};

}  // namespace wilt
