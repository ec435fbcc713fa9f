// Files, whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace wilt {

/// Writes `bytes` to the file `path`, whole or not at all.
///
/// A regular file is written without a name (where the file system can) in the same folder, flushed to the
/// disk and renamed: a reader sees the old file or the new one, a program that is killed leaves nothing. An
/// existing file keeps its permissions, a new one follows the umask; a symbolic link is followed. A pipe or a
/// device is written in place; so are /dev/stdout, /dev/stderr and /dev/fd/N. Throws Error{output} with the
/// path, the reason and what to do; then no temporary file is left.
void write_file(const std::string& path, std::string_view bytes);

/// Throws Error{output} unless `path` can become a file: its folder exists and may be written to.
void check_writable(const std::string& path);

/// The end of a file's name in lower case, with its dot: ".glb"; empty when it has none.
std::string extension_of(const std::string& path);

/// What read_file takes at most: as much as a GLB can hold.
inline constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 32;

/// All bytes of the file `path`, at most `most`; a pipe is read to its end, a device too. Throws Error{input}
/// with the path and the reason, and for what is larger.
std::string read_file(const std::string& path, std::uint64_t most = kLargestFile);

}  // namespace wilt
