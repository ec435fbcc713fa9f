// The species presets (presets/*.toml) as they are read; inside the leaf room only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wilt/leaf/species.hpp"

namespace wilt::detail {

struct PresetText {
  std::string_view name;
  std::string_view text;  ///< TOML
};

/// The embedded files, in the order of Table 1, "generic" last.
const std::vector<PresetText>& preset_texts();

enum class NodeKind { smooth, tip, tooth, sinus };

/// A node of the margin in the frame of its lobe's vein: x across (away from the apex), y along.
struct MarginNode {
  Vec2 at;
  NodeKind kind = NodeKind::smooth;
};

/// The nodes that belong to one lobe, from its side towards the base to its side towards the apex.
struct LobeNodes {
  double angle = 0.0;   ///< radians, between the lobe's vein and the midrib
  double length = 1.0;  ///< of the vein, in units of the leaf's length
  std::vector<MarginNode> nodes;
};

/// Regular teeth along the margin; none when pitch is 0.
struct TeethRule {
  double pitch = 0.0;   ///< in units of the leaf's length
  double depth = 0.3;   ///< of the pitch
  double lean = 0.5;    ///< shift of a tooth's tip towards the lobe's tip, of the depth
  double round = 0.5;   ///< 0 straight-sided, 1 crenate
  double minor = 0.0;   ///< every other tooth is smaller by this share
  double start = 0.05;  ///< no teeth before this share of the way from sinus to tip
  double end = 0.95;    ///< nor after this
};

/// Half of a margin, and how individuals differ.
struct OutlineRule {
  std::vector<LobeNodes> lobes;  ///< from the base to the apex; empty for "generic"
  TeethRule teeth;
  double blunt = 0.004;     ///< rounding of tips and teeth, in units of the leaf's length
  double vary = 0.025;      ///< relative scatter of lobes' lengths and angles
  double wave = 0.006;      ///< undulation of the margin, in units of the leaf's length
  double asymmetry = 0.03;  ///< how much larger one side of the base is
  double bend = 0.05;       ///< sideways bend of the midrib, in units of the leaf's length
};

struct Preset {
  Species species;
  OutlineRule outline;
};

/// Throws Error{configuration}, naming file, key and value, when a text is not a preset.
Preset parse_preset(const PresetText& source);

/// A built-in preset. Throws Error{input} with the nearest name when it is unknown.
const Preset& preset(std::string_view name);

}  // namespace wilt::detail
