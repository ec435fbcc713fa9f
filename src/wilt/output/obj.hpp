// Wavefront OBJ: the leaf at one frame.
#pragma once

#include <string>

#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

/// The leaf at `frame` as the text of an OBJ: objects "blade" and, when the frame has a stalk, "stalk".
///
/// Coordinates as in coordinates.hpp, Y up; nine digits. The blade has one `v` and `vn` per vertex of the
/// mesh, in its order, and one `vt` per skin vertex (origin bottom left, as OBJ has it), so seams stay
/// joined: f v/vt/vn. `stalk_sides` 3 to 64. Same input, same bytes.
std::string obj_text(const Leaf& leaf, const Frame& frame, int stalk_sides = 10);

/// The same into a file, by write_file().
void write_obj(const std::string& path, const Leaf& leaf, const Frame& frame, int stalk_sides = 10);

}  // namespace wilt
