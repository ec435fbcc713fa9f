// The six species that wilt knows: shape, physiology, veins and pigments, read from presets/*.toml.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt {

/// How secondary veins leave the primary ones.
struct SecondaryVeinRule {
  double angle = 0.9;      ///< radians between a secondary vein and its primary, at the base
  double angle_tip = 0.7;  ///< the same near the tip
  double spacing = 0.24;   ///< along the primary, in units of sqrt(blade area)
  bool alternate = true;   ///< left and right in turn, or opposite
  double curvature = 0.3;  ///< turn towards the tip along the vein, radians
};

/// Table 1 of the paper and the calibrations of the cell model.
struct Physiology {
  double mass_min = 0.80;          ///< m_min, at the margin
  double mass_max = 1.50;          ///< m_max, on the veins
  double leaf_parameter = 4.0e-3;  ///< K
  double dehydration_rate = 0.02;  ///< w_loss at 20 C and 50 %, water per unit time
  double force_range = 1.0;        ///< K_r, per working length unit
  double dryness_scale = 0.3;      ///< d: dryness = (w_0 - w) / (d w_0); a calibration
  double shrinkage = 1.0;          ///< s of the differential strain
  double roll = 60.0;              ///< curvature of the dry margin, 1 / leaf length; > 0 rolls up
};

/// What the blade's tissue holds, fresh and dead (leaf_optics.hpp has the units), and how it gets there
/// (simulation/senescence.hpp). Amounts are of the order that is measured in such leaves, chosen so that the
/// colours look like photographs of the species; a calibration.
struct Pigmentation {
  double chlorophyll = 40.0;       ///< fresh, ug/cm2
  double chlorophyll_left = 0.02;  ///< share of it that a dead leaf keeps, 0 to 1
  double carotenoids = 8.0;        ///< fresh, ug/cm2
  double carotenoids_left = 0.25;  ///< share of them that a dead leaf keeps, 0 to 1
  double anthocyanin = 0.0;        ///< made while the green goes, where the leaf reddens most, ug/cm2
  double brown = 1.0;              ///< brown pigment of dead tissue
  double structure = 1.5;          ///< N, fresh
  double structure_dry = 2.2;      ///< N, dead: air where water was
  double water = 0.012;            ///< fresh, cm
  double dry_matter = 0.006;       ///< g/cm2
  double vein_pigment = 0.4;       ///< chlorophyll of a main vein over the blade's, 0 to 1
  double vein_brown = 0.6;         ///< brown pigment of a dead main vein over the blade's, 0 to 2
  double margin_lead = 0.35;  ///< how far the margin goes ahead of the main veins, of the dryness, 0 to 1
  double patchiness = 0.12;   ///< scatter of patches in the same unit, 0 to 0.5
  std::array<int, 3> stalk{120, 110, 60};  ///< 8-bit sRGB
};

struct Species {
  std::string name;            ///< "maple"
  std::string botanical;       ///< "Acer platanoides"
  std::string common;          ///< "Norway maple"
  double length = 0.1;         ///< metres, petiole to the farthest point
  double stalk_length = 0.5;   ///< in units of the leaf's length
  double stalk_radius = 0.01;  ///< in units of the leaf's length
  SecondaryVeinRule secondary;
  Physiology physiology;
  Pigmentation pigments;
};

/// maple, poplar, tilia, ivy, willow, grape: in the order of the paper's Table 1.
const std::vector<std::string>& species_names();

/// Also accepts "generic". Throws Error{input} with the nearest name when it is unknown.
const Species& species(std::string_view name);

/// Builds a leaf of one of the six species: outline, mesh, gentle relief, stalk. `vertices` 200 to 1,000,000;
/// `seed` varies the individual. Deterministic.
Leaf make_leaf(std::string_view species_name, int vertices, std::uint64_t seed, const Monitor& monitor = {});

}  // namespace wilt
