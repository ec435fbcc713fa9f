// The veins of a leaf as files: JSON for programs, SVG to look at, OBJ for 3D tools.
#pragma once

#include <string>
#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// {"leaf": {"vertices", "faces", "length", "boundary_vertices"}, "petiole": {"vertex", "position", "uv",
/// "pixel"}, "margin": {"s", "d"}, "tips": [{"vertex", "position", "uv", "pixel", "s", "d", "prominence"}],
/// "veins": [{"order", "tip", "length", "positions", "uv"}]}.
///
/// Lengths (length, s, d, prominence) in metres; positions at rest in the coordinates of coordinates.hpp, as
/// in the GLB; uv with the origin top left; "pixel" only of a leaf with a photo; "tip" only for primary
/// veins.
std::string veins_json(const Leaf& leaf, const Venation& venation);

/// The veins of such a file, edited or not, drawn on `leaf`, whose veins `found` are: polylines moved,
/// deleted or added, as "positions", "uv" or "pixel" of a photo (or several that agree); points up to 2 % of
/// the leaf's size beside the blade are moved onto it. Of the rest only "order" and "leaf" are looked at. A
/// vein as it was written is known again. `name` is used in messages. Throws Error{input} for what is no such
/// file, a point farther off, or another leaf's veins. O(points that were edited * #F).
std::vector<DrawnVein> parse_veins_json(const std::string& text, const std::string& name, const Leaf& leaf,
                                        const Venation& found);

/// A drawing of the leaf at rest seen from above, 1 unit = 1 mm: outline (holes too), stalk, tapering veins
/// (secondary below primary), numbered tips.
std::string veins_svg(const Leaf& leaf, const Venation& venation);

/// Polylines (`l`), one object per vein, Y up, coordinates of coordinates.hpp.
std::string veins_obj(const Leaf& leaf, const Venation& venation);

using VeinsWriter = std::string (*)(const Leaf&, const Venation&);

/// What makes the text of a file of this name: .json, .svg or .obj, as above. Throws Error{configuration} for
/// another.
VeinsWriter veins_writer(const std::string& path);

}  // namespace wilt
