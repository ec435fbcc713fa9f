// A mesh file as a leaf. Inside the import room only.
#pragma once

#include "wilt/import/mesh_file.hpp"
#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

/// Repairs what a file held, finds the petiole, remeshes if asked, and places the leaf in its frame.
/// Throws Error{input} when it is no sheet.
Leaf leaf_from_mesh(const TriangleSoup& soup, const std::string& name, const ReadOptions& options,
                    const Monitor& monitor);

/// Says so when a length is none that a leaf has (below 2 mm or above 2 m).
void note_implausible_length(Leaf& leaf, const std::string& unit_advice);

}  // namespace wilt::detail
