// What a GLB of wilt shows, however it came about: moving meshes, a texture, words about itself.
#pragma once

#include <string>
#include <vector>

#include "wilt/output/frame_choice.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {

/// Meshes at chosen frames. Texture and relief are those of the first mesh.
struct GlbScene {
  std::vector<Moving> meshes;   ///< >= 1
  FrameChoice frames;           ///< those that are shown, >= 1
  std::vector<int> iterations;  ///< one for each of them, ascending
  std::vector<double> times;    ///< seconds, one for each of them: key_times() of clip_options.hpp
  std::string texture;          ///< bytes of a PNG or JPEG; empty: white
  std::string normal_texture;   ///< the same of a normal map; empty: none
  std::string extras = "{}";    ///< JSON text of asset.extras.wilt
};

/// The blade, and the stalk if there is one, at the frames that the options choose. Refers to the clip.
GlbScene glb_scene(const Clip& clip, const GlbOptions& options);

/// The bytes of the GLB; glb_bytes(Clip) in gltf.hpp says what is in it. Throws Error{output} above 4 GB.
std::string glb_bytes(const GlbScene& scene);

}  // namespace wilt
