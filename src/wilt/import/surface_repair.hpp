// From the triangles of a file to one clean sheet. Inside the import room only.
#pragma once

#include <string>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/import/mesh_file.hpp"
#include "wilt/leaf/leaf.hpp"

namespace wilt::detail {

struct Sheet {
  SurfaceMesh mesh;
  Points3 positions;  ///< #V x 3, as in the soup
  Skin skin;          ///< empty when the file has no texture coordinates
};

/// Joins vertices at one place (exactly, then within 1e-5 of the bounding box if that joins pieces), drops
/// degenerate and repeated faces, keeps the piece of largest area, turns faces to one side, splits vertices
/// where fans meet, drops unused vertices, and validates. Every repair but the exact joining and the unused
/// vertices is said in `notes`. Throws Error{input}. O(#F log #F), deterministic.
Sheet repair_surface(const TriangleSoup& soup, std::vector<std::string>& notes);

}  // namespace wilt::detail
