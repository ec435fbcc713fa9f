// Text within HTML and SVG.
#pragma once

#include <string>

namespace wilt {

/// `text` with the characters that markup takes for its own (& < > ") as entities.
std::string markup_text(const std::string& text);

}  // namespace wilt
