#include "wilt/leaf/species.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/colour.hpp"

namespace wilt {

GlbScene glb_scene(const Leaf& leaf, const Venation& venation, const Config& config,
                   const std::vector<Frame>& frames) {
  const LeafColours& colours = species(config.species).colours;
  GlbScene scene{leaf, frames};
  scene.venation = &venation;
  scene.config = to_json(config);
  for (const Frame& frame : frames)
    scene.colours.push_back(leaf_colours(leaf, venation, colours, frame.dryness));
  scene.stalk_colours.push_back(linear_rgb(colours.stalk));
  return scene;
}

}  // namespace wilt
