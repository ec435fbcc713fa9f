// How leaf tissue changes as it dries: state -> pigments -> colour. Never by time.
//
// Age a runs from 0 (fresh) to 1 (dead and dry), and on to 1.5 in necrotic spots:
//   a = dryness (1 + ahead),  ahead = lead (reach - 1/4) + gap + rim + patches
// reach: distance to the nearest primary vein over the largest; gap: tissue between veins goes ahead of
// tissue beside them; rim: so does the margin; patches: smooth seeded noise. Then, s(p, q; a) being smooth
// steps: chlorophyll falls first, 1 - s(.08, .62); carotenoids linger, 1 - s(.5, 1.05); anthocyanin rises
// while the green goes and is mostly broken down at death; brown pigment comes with cell death, s(.55, 1),
// and N with it, air for water. The order and the intervals follow descriptions of autumn leaves (Matile
// 2000; Merzlyak et al. 1999); the numbers are a calibration.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/leaf/leaf_optics.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

inline constexpr double kOldest = 1.5;         ///< the largest age
inline constexpr double kOldestTissue = 1.15;  ///< and the largest outside spots, which a texture shows

/// The state of a piece of tissue, as far as its colour depends on it.
struct TissueState {
  double age = 0.0;      ///< 0 to kOldest
  double redness = 0.0;  ///< share of the species' anthocyanin that is made here, 0 to 1
  double vein = 0.0;     ///< 1 on a main vein's axis, 0 in the tissue between
};

/// The tissue of a species in a state. Throws nothing; the state is clipped to its ranges.
LeafTissue senescent_tissue(const Pigmentation& pigments, const TissueState& state);

/// The share of its anthocyanin that tissue has made at an age, 0 to 1: only then does its redness show.
double red_made(double age);

/// What decides, beside dryness, where a leaf changes first; fixed for a leaf. #V each.
struct SenescencePattern {
  Eigen::VectorXd ahead;            ///< relative, about -0.5 to 0.7
  Eigen::VectorXd redness;          ///< 0 to 1
  Eigen::VectorXd margin_distance;  ///< metres
};

/// Deterministic; varies with the leaf's seed. O(#V log #V).
SenescencePattern senescence_pattern(const Leaf& leaf, const Venation& venation,
                                     const Pigmentation& pigments);

/// a = dryness (1 + ahead), within 0 and 1.15: older tissue is in spots, which a texture shows.
double tissue_age(double dryness, double ahead);

/// The colours of a species' tissue, tabulated over its states for quick look-up: leaf_light(
/// senescent_tissue(state)).reflectance within 0.006 of a channel's 1.
class TissueColours {
 public:
  explicit TissueColours(const Pigmentation& pigments);
  Vec3 operator()(const TissueState& state) const;

 private:
  static constexpr int kAges = 91, kReds = 9, kVeins = 17;
  std::vector<Eigen::Array4f> table_;
};

/// Reflected colour of the upper side, linear RGB, #V x 3, for a state of dryness (#V, 0 to 1): of the tissue
/// between veins, which are finer than a mesh.
Points3 leaf_colours(const SenescencePattern& pattern, const TissueColours& colours,
                     const Eigen::VectorXd& dryness);

}  // namespace wilt
