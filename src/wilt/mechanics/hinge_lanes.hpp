// Eight hinges at a time: the angle and its gradient, as hinge_geometry.hpp has them (internal).
#pragma once

#include "wilt/core/simd.hpp"
#include "wilt/core/simd_atan2.hpp"

namespace wilt::detail {

struct HingeLanes {
  Double8 sound;  ///< 1; 0 where a triangle is flat: then the others are finite and mean nothing
  Double8 angle;
  Point8 gradient[4];
};

/// `corners`: 4 x 8 indices, all first corners, then all second ones, ...; x as #V x 3 numbers.
WILT_INLINE HingeLanes hinge_lanes(const double* x, const int* corners) {
  constexpr double kFlattest2 = 1e-24;  // (|N| / |e|^2)^2 below which a triangle has no normal
  const Point8 x0 = simd::gather(x, corners), x1 = simd::gather(x, corners + simd::kLanes);
  const Point8 e = x1 - x0;
  const Point8 a = simd::gather(x, corners + 2 * simd::kLanes) - x0;
  const Point8 b = simd::gather(x, corners + 3 * simd::kLanes) - x0;
  const Point8 normal_a = cross(e, a), normal_b = cross(b, e);
  Double8 length2 = dot(e, e), a2 = dot(normal_a, normal_a), b2 = dot(normal_b, normal_b);
  const Double8 least = kFlattest2 * length2 * length2, one = Double8{} + 1.0;
  const auto sound = (a2 > least) & (b2 > least);
  length2 = sound ? length2 : one, a2 = sound ? a2 : one, b2 = sound ? b2 : one;

  HingeLanes lanes;
  lanes.sound = sound ? one : Double8{};
  const Double8 length = simd::sqrt(length2);
  lanes.angle = simd::atan2(dot(cross(normal_a, normal_b), e) / length, dot(normal_a, normal_b));
  const Double8 foot_a = dot(a, e) / length2, foot_b = dot(b, e) / length2;  // from x0, in lengths of e
  const Point8 tip_a = (-length / a2) * normal_a, tip_b = (-length / b2) * normal_b;
  lanes.gradient[0] = (foot_a - 1.0) * tip_a + (foot_b - 1.0) * tip_b;
  lanes.gradient[1] = -foot_a * tip_a - foot_b * tip_b;
  lanes.gradient[2] = tip_a;
  lanes.gradient[3] = tip_b;
  return lanes;
}

}  // namespace wilt::detail
