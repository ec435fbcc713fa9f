// Values of options that are more than one word or number.
#pragma once

#include <string>

#include "wilt/core/types.hpp"

namespace wilt::cli {

/// Two finite numbers with `separator` between them: "1.5,-2". Throws Error{configuration}, which begins with
/// `what`: "--view takes two numbers like -75,45".
Vec2 parse_pair(const std::string& text, char separator, const std::string& what);

struct PixelSize {
  int width = 0, height = 0;
};

/// "640x480": whole numbers, in no particular range. Throws as parse_pair().
PixelSize parse_size(const std::string& text, const std::string& what);

}  // namespace wilt::cli
