// A smooth step between two values.
#pragma once

#include <algorithm>

namespace wilt {

/// 0 below `a`, 1 above `b`, 3 t^2 - 2 t^3 between; a < b.
inline double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace wilt
