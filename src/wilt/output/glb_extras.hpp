// What a GLB of wilt says about itself.
#pragma once

#include <string>

#include "wilt/output/clip.hpp"
#include "wilt/output/frame_choice.hpp"

namespace wilt {

/// JSON text of asset.extras.wilt for the frames of the choice; glb_bytes() lists its keys. Text that is not
/// UTF-8 gets replacement characters.
std::string glb_extras(const Clip& clip, const FrameChoice& choice);

}  // namespace wilt
