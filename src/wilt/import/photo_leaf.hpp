// A photographed leaf. Inside the import room only.
#pragma once

#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

/// Separates the blade from a plain background, traces it, finds its petiole, meshes it, and gives it the
/// photo as texture.
Leaf read_photo_leaf(const std::filesystem::path& file, const ReadOptions& options, const Monitor& monitor);

/// How many things in the photo may be leaves; where none may, how many things there are.
int count_photo_leaves(const std::filesystem::path& file, const ReadOptions& options);

}  // namespace wilt::detail
