// USD as text (.usda): the withering leaf with time samples, a material and its maps.
#pragma once

#include <string>

#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"

namespace wilt {

/// The clip as the text of a USD layer.
///
/// Under the default prim, Xform "leaf": Mesh "blade" (the leaf's skin, as in a GLB) and, when there is one,
/// Mesh "stalk", with time samples of points, normals, extent and displayColor (linear; of the blade, the
/// texture's mean around each vertex times its colour) and of the blade's primvars:dryness (0 to 1) and
/// primvars:water (w / m); primvars:st has its origin at the bottom left. Coordinates as in coordinates.hpp:
/// upAxis Y, metersPerUnit stated. Frames stand at their times in a clip of `seconds` with `frame_rate` time
/// codes per second, so that playing is linear between them. The materials are UsdPreviewSurface: with a
/// texture, the file `texture`, of the last frame, times a scale that gives every frame its mean colour
/// (UsdPreviewSurface cannot multiply a texture by colours per vertex); without, displayColor itself.
/// `normal_map`: the file of the normal map. Either may be empty. customLayerData.wilt: version and
/// configuration. The same clip gives the same bytes. Throws Error{configuration} for a wrong option.
/// O(#frames #V).
std::string usd_text(const ShownColours& shown, const ClipOptions& options, const std::string& texture,
                     const std::string& normal_map);

/// The same into a file, by write_file(), and beside it NAME.texture.jpg and NAME.normal.jpg (or .png: as the
/// clip has them).
void write_usd(const std::string& path, const ShownColours& shown, const ClipOptions& options = {});

}  // namespace wilt
