// PLY: the leaf at one frame, with colours and dryness per vertex.
#pragma once

#include <string>

#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"

namespace wilt {

/// The leaf at a frame of the clip as a binary little-endian PLY.
///
/// Vertices are the blade's skin vertices, as in a GLB, then the stalk's: float x y z nx ny nz s t dryness
/// (0 to 1; of the stalk 0), uchar red green blue (sRGB). (s, t) has its origin at the bottom left; where the
/// leaf has no texture coordinates, and on the stalk, it is (0, 0). Coordinates as in coordinates.hpp;
/// comments state version, unit, iteration and, in pieces, configuration. Throws Error{configuration} for a
/// wrong option. O(#V).
std::string ply_bytes(const ShownColours& shown, int frame, const ClipOptions& options = {});

/// The same into a file, by write_file().
void write_ply(const std::string& path, const ShownColours& shown, int frame,
               const ClipOptions& options = {});

}  // namespace wilt
