// How a clip is played, for every animated format.
#pragma once

#include <string>
#include <vector>

#include "wilt/simulation/result.hpp"

namespace wilt {

struct ClipOptions {
  double seconds = 4.0;               ///< length of the clip, > 0; time is proportional to the iteration
  double hours_per_iteration = 0.48;  ///< of drying, > 0
  double frame_rate = 24.0;           ///< frames per second, > 0, in formats that count in frames
  int stalk_sides = 10;               ///< corners per ring of the stalk, 3 to 64
  void validate() const;              ///< throws Error{configuration}
};

/// When each frame of a clip of `seconds` is shown: from 0 on, proportional to the iteration. One frame: 0.
std::vector<double> key_times(const std::vector<Frame>& frames, double seconds);

}  // namespace wilt
