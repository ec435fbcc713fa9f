// Vertex-animation textures: a clip for game engines, whose vertex shaders read every frame from pictures.
#pragma once

#include <string>
#include <vector>

#include "wilt/output/clip.hpp"
#include "wilt/output/clip_options.hpp"

namespace wilt {

struct AnimationTextureOptions {
  ClipOptions clip;
  bool png = false;       ///< 16-bit PNG instead of half floats in EXR
  int levels = 0;         ///< coarser meshes, 0 to 8
  void validate() const;  ///< throws Error{configuration}
};

/// A mesh that was written; level 0 is the full one.
struct WrittenLevel {
  int triangles = 0;
  double deviation = 0.0;  ///< metres, levels_of_detail.hpp
};

/// Every file that write_animation_texture() may write for `path`, NAME.vat.json.
std::vector<std::string> animation_texture_files(const std::string& path);

/// Writes NAME.vat.json, NAME.rest.glb (the first frame; TEXCOORD_1 says where its vertices stand in the
/// textures), NAME.lod1.glb ... (the same with fewer triangles), and NAME.positions, .normals and .colours
/// (.exr or .png).
///
/// A texel holds three numbers of a vertex at a frame (texel_layout.hpp): the offset of its position from the
/// rest mesh, its unit normal, its linear colour, which multiplies the GLB's texture. Blade and stalk share
/// the textures. A number is min + texel (max - min), with min and max from the JSON. Coordinates of the file
/// (coordinates.hpp): Y up, right-handed. Errors: half floats have 11 significant bits; 16 bits divide the
/// range of the offsets into 65535 steps. Throws Error{configuration} when the frames do not fit,
/// Error{output} when a file cannot be written. Deterministic.
std::vector<WrittenLevel> write_animation_texture(const std::string& path, const Clip& clip,
                                                  const AnimationTextureOptions& options);

}  // namespace wilt
