// A mesh file as a leaf. Inside the import room only.
#pragma once

#include "wilt/import/mesh_file.hpp"
#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

/// Repairs what a file held, finds the petiole, remeshes if asked, and places the leaf in its frame. `notes`
/// are those of reading it.
Leaf leaf_from_mesh(const TriangleSoup& soup, const std::string& name, std::vector<std::string> notes,
                    const ReadOptions& options, const Monitor& monitor);

/// Says so when a length is none that a leaf has (below 2 mm or above 2 m).
void note_implausible_length(Leaf& leaf, const std::string& unit_advice);

}  // namespace wilt::detail
