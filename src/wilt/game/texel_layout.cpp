#include "wilt/game/texel_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr int kLongestSide = 8192;

int power_of_two(int size) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(size)));
}

}  // namespace

TexelLayout TexelLayout::make(int vertices, int frames) {
  TexelLayout layout;
  layout.vertices = vertices;
  layout.frames = frames;
  layout.width = std::min(power_of_two(vertices), kLongestSide);
  layout.rows_per_frame = (vertices + layout.width - 1) / layout.width;
  const int room = kLongestSide / layout.rows_per_frame;
  if (room < frames)
    throw Error(
        ErrorCode::configuration,
        fmt::format("{} frames of {} vertices do not fit into a texture of {} x {} texels; at most {} "
                    "frames do (--frames), or take fewer vertices (--vertices)",
                    frames, vertices, kLongestSide, kLongestSide, room));
  layout.height = power_of_two(layout.rows_per_frame * frames);
  return layout;
}

Points2 TexelLayout::lookup(int first, int count) const {
  Points2 centres(count, 2);
  for (int i = 0; i < count; ++i)
    centres.row(i) << ((first + i) % width + 0.5) / width, ((first + i) / width + 0.5) / height;
  return centres;
}

}  // namespace wilt
