#include "wilt/render/tone.hpp"

#include <algorithm>
#include <cmath>

namespace wilt {
namespace {

struct Curve {
  double b, c;
};

// tone(0.18) = 0.18 and tone(kToneWhite) = 1, solved for b and c.
Curve curve() {
  const double grey = std::pow(0.18, kToneContrast), white = std::pow(kToneWhite, kToneContrast);
  const double b = (grey / 0.18 - white) / (grey - white);
  return {b, white * (1.0 - b)};
}

}  // namespace

double tone(double x) {
  static const Curve k = curve();
  const double p = std::pow(std::max(x, 0.0), kToneContrast);
  return std::min(p / (k.b * p + k.c), 1.0);
}

double inverse_tone(double y) {
  static const Curve k = curve();
  return std::pow(y * k.c / (1.0 - y * k.b), 1.0 / kToneContrast);
}

Vec3 radiance_of(const Vec3& srgb) {
  return srgb.unaryExpr([](double v) { return inverse_tone(decode_srgb(v)); });
}

}  // namespace wilt
