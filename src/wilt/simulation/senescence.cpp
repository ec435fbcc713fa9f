#include "wilt/simulation/senescence.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/parallel.hpp"
#include "wilt/core/smooth_step.hpp"
#include "wilt/simulation/margin_distance.hpp"
#include "wilt/simulation/smooth_noise.hpp"

namespace wilt {
namespace {

// Calibrations; lengths in units of the leaf's length.
constexpr double kGapLead = 0.16, kGapWidth = 0.022;   // tissue between veins over tissue beside them
constexpr double kRimLead = 0.22, kRimWidth = 0.022;   // the margin
constexpr double kPatchSize = 0.30, kSpeckle = 0.075;  // wavelengths of the noise
constexpr double kRedPatch = 0.60;                     // and of the red patches
constexpr double kVeinLag = 0.20;                      // how far a vein stays behind, of its age

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

double bell(double distance, double width) {
  return std::exp(-(distance / width) * (distance / width));
}

}  // namespace

double red_made(double age) {
  return smooth_step(0.2, 0.65, age);
}

LeafTissue senescent_tissue(const Pigmentation& p, const TissueState& state) {
  const double vein = std::clamp(state.vein, 0.0, 1.0), red = std::clamp(state.redness, 0.0, 1.0);
  const double a = std::clamp(state.age, 0.0, kOldest) * (1.0 - kVeinLag * vein);
  const double pale = mix(1.0, p.vein_pigment, vein);
  const double green = 1.0 - smooth_step(0.08, 0.62, a), yellow = 1.0 - smooth_step(0.5, 1.05, a);
  const double dead = smooth_step(0.55, 1.0, a), rotten = std::max(a - 1.05, 0.0) / 0.45;
  LeafTissue tissue;
  tissue.chlorophyll = pale * p.chlorophyll * mix(p.chlorophyll_left, 1.0, green);
  tissue.carotenoids = pale * p.carotenoids * mix(p.carotenoids_left, 1.0, yellow);
  tissue.anthocyanin = red * p.anthocyanin * red_made(a) * (1.0 - 0.7 * dead);
  tissue.brown = std::min(mix(1.0, p.vein_brown, vein) * p.brown * (dead + 2.5 * rotten), 5.0);
  tissue.structure =
      std::clamp(mix(p.structure, p.structure_dry, dead) + 0.3 * vein - 0.8 * rotten, 1.0, 4.0);
  tissue.water = p.water * mix(1.0, 0.08, std::min(a, 1.0));
  tissue.dry_matter = p.dry_matter;
  return tissue;
}

SenescencePattern senescence_pattern(const Leaf& leaf, const Venation& venation,
                                     const Pigmentation& pigments) {
  const double length = leaf_length(leaf);
  const Points2 plane = leaf.positions.leftCols<2>() / length;
  const Eigen::VectorXd broad = smooth_noise(plane, kPatchSize, leaf.seed, "senescence patches"),
                        small = smooth_noise(plane, kSpeckle, leaf.seed, "senescence speckle"),
                        red = smooth_noise(plane, kRedPatch, leaf.seed, "senescence red");
  const double farthest = std::max(venation.primary_distance.maxCoeff(), 1e-12 * length);
  SenescencePattern pattern;
  pattern.margin_distance = margin_distance(leaf);
  const Eigen::Index count = leaf.positions.rows();
  pattern.ahead.resize(count), pattern.redness.resize(count);
  for (Eigen::Index v = 0; v < count; ++v) {
    const double reach = venation.primary_distance[v] / farthest;
    const double beside = bell(venation.vein_distance[v], kGapWidth * length);
    const double rim = bell(pattern.margin_distance[v], kRimWidth * length);
    pattern.ahead[v] = pigments.margin_lead * (reach - 0.25) + kGapLead * (0.35 - beside) + kRimLead * rim +
                       pigments.patchiness * (broad[v] + 0.5 * small[v]);
    // More towards the margin, in patches.
    pattern.redness[v] = smooth_step(-1.2, 1.8, red[v] + 0.15 * small[v] + 1.2 * (reach - 0.4));
  }
  return pattern;
}

double tissue_age(double dryness, double ahead) {
  return std::clamp(dryness * (1.0 + ahead), 0.0, kOldestTissue);
}

TissueColours::TissueColours(const Pigmentation& pigments)
    : table_(static_cast<std::size_t>(kAges) * kReds * kVeins) {
  const QuickReflectance reflectance;
  parallel_for(kAges, 8, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      for (int j = 0; j < kReds; ++j) {
        for (int k = 0; k < kVeins; ++k) {
          const TissueState state{kOldest * i / (kAges - 1), j / (kReds - 1.0), k / (kVeins - 1.0)};
          table_[static_cast<std::size_t>((i * kReds + j) * kVeins + k)]
              << reflectance(senescent_tissue(pigments, state)).cast<float>(),
              0.0F;
        }
      }
    }
  });
}

Vec3 TissueColours::operator()(const TissueState& state) const {
  const auto place = [](double value, double most, int count, int& cell) {
    const double x = std::clamp(value / most, 0.0, 1.0) * (count - 1);
    cell = std::min(static_cast<int>(x), count - 2);
    return static_cast<float>(x - cell);
  };
  int i = 0, j = 0, k = 0;
  const float s = place(state.age, kOldest, kAges, i), t = place(state.redness, 1.0, kReds, j),
              u = place(state.vein, 1.0, kVeins, k);
  const auto along_vein = [&](int di, int dj) -> Eigen::Array4f {
    const Eigen::Array4f* from = &table_[static_cast<std::size_t>(((i + di) * kReds + j + dj) * kVeins + k)];
    return from[0] + u * (from[1] - from[0]);
  };
  const Eigen::Array4f young = along_vein(0, 0) + t * (along_vein(0, 1) - along_vein(0, 0)),
                       old = along_vein(1, 0) + t * (along_vein(1, 1) - along_vein(1, 0));
  return (young + s * (old - young)).head<3>().matrix().cast<double>();
}

Points3 leaf_colours(const SenescencePattern& pattern, const TissueColours& colours,
                     const Eigen::VectorXd& dryness) {
  Points3 result(dryness.size(), 3);
  parallel_for(static_cast<int>(dryness.size()), 1024, [&](int begin, int end) {
    for (int v = begin; v < end; ++v)
      result.row(v) =
          colours({tissue_age(dryness[v], pattern.ahead[v]), pattern.redness[v], 0.0}).transpose();
  });
  return result;
}

}  // namespace wilt
