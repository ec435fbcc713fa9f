// A withering leaf frame by frame, with its colours: what the writers of animated files take.
#pragma once

#include <string>
#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// A withering leaf as files hold it: shapes, colours, maps. Only refers to `leaf`, `frames` and `venation`:
/// they must outlive it.
struct Clip {
  const Leaf& leaf;
  const std::vector<Frame>& frames;    ///< >= 1, iterations ascending; the first is at rest
  const Venation* venation = nullptr;  ///< drawn at rest
  std::string config = "{}";           ///< JSON text of the resolved configuration
  /// Linear RGB, 0 to 1 (clipped), #V x 3 of the blade, which multiplies the texture: none (white), one
  /// (shown throughout: the final state), or one per frame (colour morphs).
  std::vector<Points3> colours{};
  std::vector<Vec3> stalk_colours{};  ///< linear RGB, of the whole stalk: none, one, or one per frame
  std::string texture{};              ///< bytes of a PNG or JPEG that multiplies the colours; empty: white
  std::string normal_texture{};       ///< the same of a tangent-space normal map of the blade; empty: none
};

/// The clip of a run: its frames with the colours of their states, veins and configuration. Refers to
/// `leaf`, `venation` and `frames`, which must have a dryness.
///
/// With C_k the blade's colours at frame k (senescence.hpp), the texture holds the last frame's colour times
/// m >= 1 per channel, with its fine detail, and COLOR_0 of frame k is C_k / (C_last m): texture x COLOR_0 is
/// the colour of that frame, and COLOR_0 of the last one is 1 / m throughout. Without a texture
/// (`texture.size` 0, or texture coordinates that cannot carry one) COLOR_0 is C_k.
Clip make_clip(const Leaf& leaf, const Venation& venation, const Config& config,
               const std::vector<Frame>& frames);

/// The leaf alone, as the one frame of a clip: rest positions and stalk, fresh (dryness 0), no water.
std::vector<Frame> rest_frames(const Leaf& leaf);

}  // namespace wilt
