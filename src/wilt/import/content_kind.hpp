// What a file holds, by its first bytes. Inside the import room only.
#pragma once

#include <string>
#include <string_view>

namespace wilt::detail {

/// "; it holds a PNG picture: call it .png" when the bytes are those of another kind of file than
/// `extension` says, with what to do; "" when they may be, or nobody can tell. For the end of a refusal.
std::string wrong_kind_hint(std::string_view bytes, const std::string& extension);

}  // namespace wilt::detail
