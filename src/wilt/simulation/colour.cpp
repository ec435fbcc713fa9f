#include "wilt/simulation/colour.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/simulation/smooth_noise.hpp"

namespace wilt {
namespace {

constexpr double kLead = 0.5;         // how far the margin is ahead of the veins, relative
constexpr double kPatchiness = 0.15;  // of the smooth variation, relative
constexpr double kPatchSize = 0.18;   // its wavelength, in leaf lengths
constexpr double kVeinWidth = 0.006;  // half width over which a vein's colour fades, in leaf lengths

Vec3 ramp(const Vec3& fresh, const Vec3& turning, const Vec3& dry, double t) {
  const double s = 2.0 * std::clamp(t, 0.0, 1.0);
  return s < 1.0 ? Vec3((1.0 - s) * fresh + s * turning) : Vec3((2.0 - s) * turning + (s - 1.0) * dry);
}

}  // namespace

Vec3 linear_rgb(const std::array<int, 3>& srgb) {
  Vec3 linear;
  for (int k = 0; k < 3; ++k) {
    const double c = srgb[k] / 255.0;
    linear[k] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return linear;
}

Points3 leaf_colours(const Leaf& leaf, const Venation& venation, const LeafColours& colours,
                     const Eigen::VectorXd& dryness) {
  const Vec3 fresh = linear_rgb(colours.fresh), turning = linear_rgb(colours.turning),
             dry = linear_rgb(colours.dry), vein = linear_rgb(colours.vein);
  const double length = leaf_length(leaf);
  const Eigen::VectorXd noise =
      smooth_noise(leaf.positions.leftCols<2>() / length, kPatchSize, leaf.seed, "colour");
  const double farthest = std::max(venation.primary_distance.maxCoeff(), 1e-12 * length);
  Points3 result(dryness.size(), 3);
  for (int v = 0; v < dryness.size(); ++v) {
    const double reach = venation.primary_distance[v] / farthest;
    const double ahead = kLead * (reach - 0.5) + kPatchiness * noise[v];
    const double near_vein = std::exp(-std::pow(venation.vein_distance[v] / (kVeinWidth * length), 2.0));
    const Vec3 vein_now = (1.0 - 0.6 * dryness[v]) * vein + 0.6 * dryness[v] * dry;
    const Vec3 lamina = ramp(fresh, turning, dry, dryness[v] * (1.0 + ahead)) * (1.0 + 0.06 * noise[v]);
    result.row(v) =
        ((1.0 - 0.6 * near_vein) * lamina + 0.6 * near_vein * vein_now).cwiseMin(1.0).cwiseMax(0.0);
  }
  return result;
}

}  // namespace wilt
