// What a GLB of wilt says about itself.
#pragma once

#include <string>

#include "wilt/output/gltf.hpp"

namespace wilt {

/// JSON text of asset.extras.wilt; glb_bytes() lists its keys. Text that is not UTF-8 gets replacement
/// characters.
std::string glb_extras(const Clip& clip);

}  // namespace wilt
