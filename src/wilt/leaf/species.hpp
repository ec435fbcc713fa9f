// The six species that wilt knows: shape, physiology, veins and colours, read from presets/*.toml.
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

/// 8-bit sRGB colours of the blade, for pictures.
struct LeafColours {
  std::array<int, 3> fresh{72, 100, 51};
  std::array<int, 3> turning{190, 147, 44};
  std::array<int, 3> dry{151, 127, 92};
  std::array<int, 3> vein{150, 160, 95};
  std::array<int, 3> stalk{120, 110, 60};
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
  LeafColours colours;
};

/// maple, poplar, tilia, ivy, willow, grape: in the order of the paper's Table 1.
const std::vector<std::string>& species_names();

/// Also accepts "generic". Throws Error{input} with the nearest name when it is unknown.
const Species& species(std::string_view name);

/// Builds a leaf of one of the six species: outline, mesh, gentle relief, stalk. `vertices` 200 to 1,000,000;
/// `seed` varies the individual. Deterministic.
Leaf make_leaf(std::string_view species_name, int vertices, std::uint64_t seed, const Monitor& monitor = {});

}  // namespace wilt
