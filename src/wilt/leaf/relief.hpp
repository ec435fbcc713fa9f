// The gentle shape of a fresh leaf: what makes it more than a flat sheet, so that it can buckle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// Radians that the relief may take from a triangle's angle: what a planar mesh should have to spare.
inline constexpr double kReliefReserve = 0.03;

/// Height over the plane, in units of the leaf's length: z(x, y), y along the midrib, petiole at the origin.
/// Formula in relief.cpp. Slopes stay below about 0.5. Deterministic per seed.
class Relief {
 public:
  /// `tips`: the ends of the main veins, in units of the leaf's length; >= 1.
  Relief(std::vector<Vec2> tips, std::uint64_t seed);

  double operator()(const Vec2& p) const;

 private:
  struct Wave {
    Vec2 vector = Vec2::Zero();
    double phase = 0.0, amplitude = 0.0;
  };

  double vein_distance(const Vec2& p) const;

  std::vector<Vec2> tips_;
  double valley_ = 0.0, fold_ = 0.0, arch_ = 0.0, droop_ = 0.0, dome_ = 0.0;
  std::array<Wave, 7> waves_;
};

}  // namespace wilt
