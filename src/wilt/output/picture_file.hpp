// Pictures as files.
#pragma once

#include <string>

#include "wilt/core/image.hpp"

namespace wilt {

/// Whether the name ends in .png, .jpg or .jpeg.
bool is_picture_path(const std::string& path);

/// Writes the picture by its name's end, whole or not at all. Throws Error{configuration} for another end,
/// Error{output} when it cannot be written.
void write_image(const std::string& path, const Image& image);

}  // namespace wilt
