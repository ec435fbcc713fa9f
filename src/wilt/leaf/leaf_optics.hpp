// The colour of leaf tissue from what is in it: pigments, water, dry matter and structure.
//
// The plate model of Allen et al. (1969) and Jacquemoud and Baret (1990), as in PROSPECT-D (Feret et al.
// 2017): a leaf is a pile of N plates that absorb; k(lambda) = sum_i c_i K_i(lambda) / N is the absorption of
// one. The tables K_i of PROSPECT-D are not used (their published copies are under the GPL): here every K_i
// is a few bands whose places come from the literature and whose heights are fitted to four reference
// colours (leaf_optics.cpp). So colours are right near those, and absorption at one wavelength is no
// measurement.
#pragma once

#include <array>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// What a piece of blade holds. Ranges are what validate() allows.
struct LeafTissue {
  double structure = 1.5;    ///< N, plates; 1 (compact) to 4 (full of air, as when dry)
  double chlorophyll = 0.0;  ///< a + b, ug/cm2; 0 to 120
  double carotenoids = 0.0;  ///< ug/cm2; 0 to 30
  double anthocyanin = 0.0;  ///< ug/cm2; 0 to 60
  double brown = 0.0;        ///< brown pigments, arbitrary unit (1: a dead leaf); 0 to 5
  double water = 0.01;       ///< cm; 0 to 0.1. Absorbs next to nothing that is visible: less than 0.001
  double dry_matter = 0.0;   ///< g/cm2; 0 to 0.05
  void validate() const;     ///< throws Error{configuration}
};

inline constexpr int kSpectralBands = 31;  ///< 400, 410, ... 700 nm

/// Shares of the light that comes back, and that passes, diffusely; each in 0..1, their sum at most 1.
struct LeafSpectrum {
  std::array<double, kSpectralBands> reflectance{}, transmittance{};
};
LeafSpectrum leaf_spectrum(const LeafTissue& tissue);

/// Linear sRGB of a spectrum (reflectance or transmittance) under D65, CIE 1931 observer: 1 everywhere gives
/// (1, 1, 1). Not clipped: colours outside sRGB have a negative channel.
Vec3 spectrum_colour(const std::array<double, kSpectralBands>& spectrum);

/// Reflected and transmitted light as linear sRGB, D65, both clipped to 0..1, their sum at most 1 per
/// channel.
struct LeafLight {
  Vec3 reflectance, transmittance;
};
LeafLight leaf_light(const LeafTissue& tissue);

/// T_av(alpha, n): share of unpolarised light, spread evenly over directions within `alpha` (radians, up to
/// pi / 2) of the normal, that enters a medium of index `n` > 1 (Stern 1964, Allen 1973).
double entering_share(double alpha, double n);

/// E_1(x), the exponential integral, x > 0; relative error below 1e-9.
double exponential_integral(double x);

/// leaf_light(tissue).reflectance within 0.001, for many tissues: what plates reflect is interpolated in a
/// table over their number and the root of what each absorbs.
class QuickReflectance {
 public:
  QuickReflectance();
  Vec3 operator()(const LeafTissue& tissue) const;

 private:
  static constexpr int kStructures = 33, kAbsorptions = 257;
  static constexpr double kMostExtra = 3.0;  // plates beyond the first
  static constexpr double kMostRoot = 3.0;   // beyond it nothing comes back through a plate
  std::vector<double> table_;                // kStructures x kAbsorptions
};

}  // namespace wilt
