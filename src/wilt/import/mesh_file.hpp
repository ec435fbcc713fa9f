// Triangles of a mesh file as they stand there. Inside the import room only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"

namespace wilt::detail {

struct TriangleSoup {
  Points3 positions;               ///< #S x 3, Z up
  Points2 uv;                      ///< #S x 2, origin top left; not a number where the file gives none
  Faces faces;                     ///< #F x 3
  std::vector<std::string> notes;  ///< what was left out
  std::optional<Vec3> petiole{};   ///< where the stalk meets the blade, if that is known
};

/// File coordinates (Y up) to ours (Z up) and back.
inline Vec3 from_file_axes(const Vec3& file) {
  return {file.x(), -file.z(), file.y()};
}
inline Vec3 to_file_axes(const Vec3& ours) {
  return {ours.x(), ours.z(), -ours.y()};
}

/// A mesh file's bytes; `extension` (.obj .ply .stl .glb .gltf) says how to read them, and the buffers that
/// a .gltf names are looked for in `folder` alone (mesh_folder.hpp). Polygons are cut into triangles, node
/// transforms applied, points and lines left out, and so is a part named "stalk" beside others. There may be
/// no face. Throws Error{input}. The library may crash on hostile bytes: callers use read_mesh. Not
/// for several threads at once.
TriangleSoup parse_mesh(std::string_view bytes, const std::string& extension,
                        const std::filesystem::path& folder);

/// parse_mesh in a process of its own, with its limits (isolated.hpp).
TriangleSoup read_mesh(std::string_view bytes, const std::string& extension,
                       const std::filesystem::path& folder, const Monitor& monitor);

}  // namespace wilt::detail
