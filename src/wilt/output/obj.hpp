// Wavefront OBJ: the leaf at a frame, or a file per frame, with materials and textures.
#pragma once

#include <string>

#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"

namespace wilt {

/// What an OBJ refers to; none by default.
struct ObjMaterials {
  std::string library;       ///< the .mtl's file name
  std::string blade, stalk;  ///< materials in it
};

/// The leaf at a frame as the text of an OBJ: objects "blade" and, when the leaf has one, "stalk".
///
/// Coordinates as in coordinates.hpp, Y up; nine digits. The blade has one `v` and `vn` per vertex of the
/// mesh, in its order, and one `vt` per skin vertex (origin bottom left, as OBJ has it), so seams stay
/// joined: f v/vt/vn. The order is the same in every frame. Comments state version, unit, iteration and
/// configuration. Same input, same bytes. Throws Error{configuration} for a wrong option.
std::string obj_text(const Clip& clip, int frame, const ObjMaterials& materials = {},
                     const ClipOptions& options = {});

/// The leaf at a frame into a file, and beside it NAME.mtl, NAME.texture.jpg (that frame as it is shown) and
/// NAME.normal.jpg, the maps where the clip has them. By write_file(); the OBJ comes last.
///
/// Materials: Kd is sRGB, white under a texture; the normal map is `norm`.
void write_obj(const std::string& path, const ShownColours& shown, int frame,
               const ClipOptions& options = {});

/// A file per frame, numbered from 0 (beside.hpp: "leaf.####.obj"), each with a texture of its own
/// (leaf.0012.texture.jpg) and a material of its own in the one leaf.mtl; the normal map, leaf.normal.jpg, is
/// one for all. Files of a longer sequence that was there before stay. Throws Error{configuration} for a name
/// without a row of hashes.
void write_obj_sequence(const std::string& pattern, const ShownColours& shown,
                        const ClipOptions& options = {});

}  // namespace wilt
