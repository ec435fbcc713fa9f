// USD as text (.usda): the withering leaf with time samples, a material and its maps.
#pragma once

#include <string>

#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"

namespace wilt {

/// The files that stand beside a layer, by their paths; empty: none.
struct UsdMaps {
  std::string texture, normal_map;
};

/// The clip as the text of a USD layer.
///
/// Under the default prim, Xform "leaf": Mesh "blade" (the mesh's vertices, in the order of the OBJ) and,
/// when there is one, Mesh "stalk", with time samples of points, normals, extent and primvars:displayColor
/// (linear; of the blade, the texture's mean around each vertex times its colour), and of the blade's
/// primvars:dryness (0 to 1) and primvars:water (w / m). primvars:st is per corner, its origin at the bottom
/// left. Coordinates as in coordinates.hpp: upAxis Y, metersPerUnit stated. A frame stands at its time in a
/// clip of `seconds`, with `frame_rate` time codes per second; readers are linear between frames, and those
/// without time see the last.
///
/// Materials are UsdPreviewSurface. It cannot multiply a texture by colours per vertex, so the blade has its
/// texture, that of the last frame, times a scale that gives every frame its mean colour; without a texture
/// it has no material and is shown in its displayColor. customLayerData: version and configuration. The same
/// clip gives the same bytes. Throws Error{configuration} for a wrong option. O(#frames #V).
std::string usd_text(const ShownColours& shown, const ClipOptions& options = {}, const UsdMaps& maps = {});

/// The same into a file, by write_file(), and before it NAME.texture.jpg and NAME.normal.jpg beside it, where
/// the clip has them.
void write_usd(const std::string& path, const ShownColours& shown, const ClipOptions& options = {});

}  // namespace wilt
