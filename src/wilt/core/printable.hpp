// Text of unknown origin, made fit for messages and JSON.
#pragma once

#include <string>
#include <string_view>

namespace wilt {

/// `text` as valid UTF-8 without control characters: each byte that belongs to no character becomes U+FFFD,
/// each control character but a tab a '?', so it stands on one line and tells no terminal anything.
std::string printable(std::string_view text);

/// What a library's exception says, without a tag in brackets before it: "[json.exception.parse_error.101]
/// parse error at ..." becomes "parse error at ...".
std::string_view untagged(std::string_view what);

}  // namespace wilt
