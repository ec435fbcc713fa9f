#include "wilt/output/clip_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

void check_positive(const char* name, double value) {
  if (!(value > 0.0 && std::isfinite(value)))
    throw Error(ErrorCode::configuration, fmt::format("{} is {}: it must be above 0", name, value));
}

}  // namespace

void ClipOptions::validate() const {
  check_positive("seconds", seconds);
  check_positive("hours_per_iteration", hours_per_iteration);
  check_positive("frame_rate", frame_rate);
  if (stalk_sides < 3 || stalk_sides > 64)
    throw Error(ErrorCode::configuration,
                fmt::format("stalk_sides is {}: a stalk has 3 to 64 sides", stalk_sides));
}

std::vector<double> key_times(const std::vector<Frame>& frames, double seconds) {
  const double first = frames.front().iteration, last = frames.back().iteration;
  std::vector<double> times;
  for (const Frame& frame : frames)
    times.push_back(last > first ? seconds * (frame.iteration - first) / (last - first) : 0.0);
  return times;
}

}  // namespace wilt
