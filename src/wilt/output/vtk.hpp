// VTK's XML files: .vtu (a frame as an unstructured grid) and .pvd (all frames with their times).
#pragma once

#include <string>

#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"

namespace wilt {

/// The blade at a frame as a .vtu: its mesh vertices and triangles, float32, appended raw.
///
/// Point data: Normals; dryness (0 to 1) and water (w / m) where the frame has them; displacement from the
/// first frame, in the file's unit; colour, sRGB bytes. Cell data: area_ratio, of the face to itself in the
/// first frame. Field data: TimeValue (hours of drying), iteration, metres_per_unit. Coordinates as in
/// coordinates.hpp. A comment holds version and configuration. O(#V).
std::string vtu_blade(const ShownColours& shown, int frame, const ClipOptions& options = {});

/// The stalk at a frame in the same way, with Normals, displacement and colour. The frame has a stalk.
std::string vtu_stalk(const ShownColours& shown, int frame, const ClipOptions& options = {});

/// vtu_blade() into a file, by write_file().
void write_vtu(const std::string& path, const ShownColours& shown, int frame,
               const ClipOptions& options = {});

/// Where write_pvd() puts the blade and the stalk of a frame: NAME_0012.vtu, NAME_stalk_0012.vtu.
std::string pvd_blade_path(const std::string& path, int frame);
std::string pvd_stalk_path(const std::string& path, int frame);

/// A .vtu per frame beside `path`, and last the .pvd that lists them with their times in hours: part 0 the
/// blade, part 1 the stalk if there is one.
void write_pvd(const std::string& path, const ShownColours& shown, const ClipOptions& options = {});

}  // namespace wilt
