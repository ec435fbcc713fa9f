// Few frames for many: which ones to keep when a tool takes only so many.
#pragma once

#include <vector>

#include "wilt/simulation/result.hpp"

namespace wilt {

/// The frames that are kept, and what playing them misses: positions between two kept frames are linear in
/// the iteration, and differ from those of the frames that were left out.
struct FrameChoice {
  std::vector<int> kept;  ///< their numbers, ascending; the first and the last frame among them
  double rms = 0.0;       ///< metres, over all vertices of all frames
  double largest = 0.0;   ///< metres, of any vertex in any frame
};

/// Of all choices of `most` frames that keep the first and the last, the one with the smallest sum of squared
/// deviations of the blade's vertices and the stalk's points, over the frames that are left out. All frames,
/// when there are no more than `most`.
///
/// By dynamic programming over pairs of neighbours, from the frames' inner products: O(#V #F^2 + #F^3).
/// Throws Error{configuration} for `most` below 2, or when it must choose from more than 2,000 frames.
/// Deterministic.
FrameChoice choose_frames(const std::vector<Frame>& frames, int most);

}  // namespace wilt
