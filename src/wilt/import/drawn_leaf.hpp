// An outline from a file, before it is a leaf. Inside the import room only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/import/read_leaf.hpp"
#include "wilt/import/svg_element.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

struct DrawnLeaf {
  Outline outline;              ///< in the file's units, y up
  std::optional<Vec2> petiole;  ///< as the file or the user gave it, or as it was found, y up
  std::string petiole_reason;   ///< how it was found; empty: given
  double mm_per_unit = 1.0;
  bool y_down = false;                     ///< whether the file's y runs down: for messages
  std::shared_ptr<const LeafPhoto> photo;  ///< whose pixels are the outline's units
  std::vector<std::string> notes;
};

/// {"outline": [[x, y], ...], "holes": [[[x, y], ...], ...], "petiole": [x, y], "mm_per_unit": 1}, y up;
/// only "outline" must be there. Throws Error{input}, naming the place, for anything else.
DrawnLeaf parse_json_outline(std::string_view text);

/// The `nth` largest leaf of a drawing, its stalk joined to it if that is a shape of its own. Throws
/// Error{input}.
DrawnLeaf outline_of_drawing(const svg::Elements& elements, int nth);

/// The same of an SVG file's text. Nothing that the drawing refers to is opened, and its XML entities are not
/// expanded. Throws Error{input}.
DrawnLeaf parse_svg_outline(std::string_view text, int nth);

/// parse_svg_outline in a process of its own, with its limits (isolated.hpp).
DrawnLeaf read_svg_outline(std::string_view text, int nth, const Monitor& monitor);

/// Cuts off the stalk, finds the petiole, meshes, and places the leaf in its frame.
Leaf leaf_from_outline(DrawnLeaf drawn, const std::string& name, const ReadOptions& options,
                       const Monitor& monitor);

}  // namespace wilt::detail
