// Triangles of a mesh file as they stand there. Inside the import room only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::detail {

struct TriangleSoup {
  Points3 positions;  ///< #S x 3, Z up
  Points2 uv;         ///< #S x 2, origin top left; not a number where the file gives none
  Faces faces;        ///< #F x 3
};

/// File coordinates (Y up) to ours (Z up) and back.
inline Vec3 from_file_axes(const Vec3& file) {
  return {file.x(), -file.z(), file.y()};
}
inline Vec3 to_file_axes(const Vec3& ours) {
  return {ours.x(), ours.z(), -ours.y()};
}

/// Reads .obj .ply .stl .glb .gltf; polygons are cut into triangles, node transforms applied, points and
/// lines left out, and so is a part named "stalk" beside others. There may be no face. Throws Error{input}.
TriangleSoup read_mesh_file(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace wilt::detail
