// The container of a GLB: a header, a JSON chunk, a binary chunk (glTF 2.0, section 4.4).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace wilt {

/// The bytes of a GLB; little-endian, chunks padded to 4 bytes. `binary` becomes part of it where it has the
/// capacity to. Throws Error{output} above 4 GB, which the
/// format's 32-bit length cannot state.
std::string join_glb(std::string_view json, std::string binary);

/// The JSON text of a GLB. Throws Error{input}, naming `name`, when `bytes` are no GLB of version 2 or are
/// cut off.
std::string_view glb_json(std::string_view bytes, const std::string& name);

}  // namespace wilt
