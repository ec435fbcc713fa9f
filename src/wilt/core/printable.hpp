// Text of unknown origin, made fit for messages and JSON.
#pragma once

#include <string>
#include <string_view>

namespace wilt {

/// `text` as valid UTF-8 without control characters: each byte that belongs to no character becomes U+FFFD,
/// each control character but a line's end and a tab (so no terminal is told anything) a '?'.
std::string printable(std::string_view text);

}  // namespace wilt
