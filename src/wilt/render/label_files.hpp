// Labels as files: PNG for the maps, JSON for what they mean.
#pragma once

#include <string>
#include <vector>

#include "wilt/render/label_maps.hpp"

namespace wilt {

/// Each is a PNG without loss, written to STEM.KIND.png.
enum class LabelKind {
  leaf,    ///< 8 bits: 255 where the leaf is (blade or stalk), else 0
  part,    ///< 8 bits: 0 background, 1 blade, 2 stalk
  vein,    ///< 8 bits: order of the vein, 0 beside veins
  water,   ///< 16 bits: w / m = value / 65535; 0 off the blade
  depth,   ///< 16 bits: metres along the camera's axis = value * depth_unit(); 0 for background
  normals  ///< 3 x 16 bits: x, y, z = (value - 32768) / 32767; 0 for background
};
const char* label_name(LabelKind kind);  ///< "leaf"
const std::vector<LabelKind>& all_label_kinds();

/// Metres in a step of the depth file: the smallest of 1, 2, 5, 10, ... micrometres for which the farthest
/// point fits into 16 bits.
double depth_unit(const LabelMaps& maps);

/// Writes the chosen maps, each whole or not at all; returns their paths. Throws Error{output}.
std::vector<std::string> write_label_maps(const std::string& stem, const LabelMaps& maps,
                                          const std::vector<LabelKind>& kinds);

/// JSON text of what is known of the picture as a whole: "width", "height"; "box" [left, top, width, height]
/// and "area" of the leaf, pixels; "pixels" of each part and each vein's order; "vein_width" by order,
/// metres; "depth_unit", metres, "depth" [nearest, farthest]; "water", mean over the pixels of the blade;
/// "base", "apex" and "tips" as [x, y, v], pixels, v as in COCO (0: outside the picture, x = y = 0; 1:
/// hidden; 2: seen); null where the leaf has none; "camera": "focal" and "centre", pixels (x right, y down),
/// and "position", "right", "up", "forward" in the axes of the table (Z up), metres.
std::string label_json(const LabelMaps& maps);

}  // namespace wilt
