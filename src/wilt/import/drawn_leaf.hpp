// From drawings and outlines to leaves. Inside the import room only.
#pragma once

#include <string>
#include <string_view>

#include "wilt/import/leaf_in_memory.hpp"
#include "wilt/import/svg_element.hpp"

namespace wilt::detail {

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
