#include "wilt/output/clip.hpp"

#include "wilt/output/leaf_paint.hpp"

namespace wilt {

Clip make_clip(const Leaf& leaf, const Venation& venation, const Config& config,
               const std::vector<Frame>& frames) {
  std::vector<Eigen::VectorXd> states;
  for (const Frame& frame : frames) states.push_back(frame.dryness);
  const LeafPaint paint(leaf, venation, config, states);
  Clip clip{leaf, frames};
  clip.venation = &venation;
  clip.config = to_json(config);
  clip.texture = paint.texture();
  clip.normal_texture = paint.normal_texture();
  for (const Eigen::VectorXd& dryness : states) {
    clip.colours.push_back(paint.blade(dryness));
    clip.stalk_colours.push_back(paint.stalk(dryness));
  }
  return clip;
}

}  // namespace wilt
