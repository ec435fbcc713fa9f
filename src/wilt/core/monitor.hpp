// Progress and cancellation of long computations.
#pragma once

#include <functional>
#include <string_view>

#include "wilt/core/error.hpp"

namespace wilt {

/// Callbacks of a long computation; an empty one is ignored. Called from the calling thread only.
struct Monitor {
  std::function<void(std::string_view stage, double fraction)> progress;  ///< fraction in [0, 1]
  std::function<bool()> cancelled;                                        ///< true: stop soon
  std::function<void(std::string_view message)> note;                     ///< a fact the user should know

  void report(std::string_view stage, double fraction) const {
    if (progress) progress(stage, fraction);
  }
  bool stop_requested() const { return cancelled && cancelled(); }
  void say(std::string_view message) const {
    if (note) note(message);
  }

  /// Throws Error{interrupted} when the user asked to stop.
  void throw_if_cancelled() const {
    if (stop_requested()) throw Error(ErrorCode::interrupted, "interrupted");
  }
};

}  // namespace wilt
