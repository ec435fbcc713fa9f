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
/// Colours, texture and normal map as in leaf_paint.hpp; the texture is of the last frame.
Clip make_clip(const Leaf& leaf, const Venation& venation, const Config& config,
               const std::vector<Frame>& frames);

/// The leaf alone, as the one frame of a clip: rest positions and stalk, fresh (dryness 0), no water.
std::vector<Frame> rest_frames(const Leaf& leaf);

}  // namespace wilt
