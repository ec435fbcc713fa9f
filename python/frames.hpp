// Frames for Python.
#pragma once

#include "objects.hpp"

namespace wilt::python {

/// #V x 3, linear RGB, 0 to 1, of the blade's upper side; of a leaf from a photo, its own colours aged. As
/// the files of a result have them, without the fine detail of textures.
Points3 colours_of(const FrameObject& frame);

}  // namespace wilt::python
