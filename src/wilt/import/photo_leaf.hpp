// A photographed leaf. Inside the import room only.
#pragma once

#include <string>
#include <string_view>

#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

/// Separates the blade from a plain background, traces it, finds its petiole, meshes it, and gives it the
/// photo as texture.
Leaf leaf_from_photo(std::string_view bytes, const std::string& name, const ReadOptions& options,
                     const Monitor& monitor);

/// How many things in the photo may be leaves; where none may, how many things there are.
int count_photo_leaves(std::string_view bytes, const ReadOptions& options);

}  // namespace wilt::detail
