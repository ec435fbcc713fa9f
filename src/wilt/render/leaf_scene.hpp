// The picture of a result: what a GLB of wilt holds, as a scene.
#pragma once

#include "wilt/output/gltf.hpp"
#include "wilt/render/scene.hpp"

namespace wilt {

/// Blade, stalk and veins at a frame (0 to file.times.size() - 1), in the units of the file, Z up.
///
/// The leaf as it would lie on a table: the mean normal of its blade up, the way from its base to the middle
/// of the blade along +y, the base in the origin. How it hangs is for the file to show. Throws
/// std::logic_error for a frame that is not there. O(#V).
Scene leaf_scene(const GlbFile& file, int frame);

}  // namespace wilt
