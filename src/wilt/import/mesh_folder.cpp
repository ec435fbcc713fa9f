#include "wilt/import/mesh_folder.hpp"

#include <fmt/format.h>

#include <assimp/MemoryIOWrapper.h>
#include <algorithm>
#include <charconv>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt::detail {
namespace {

namespace fs = std::filesystem;

Assimp::IOStream* stream_of(std::string_view bytes) {
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// %20 and the like, as a URI has them.
std::string percent_decoded(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      path += static_cast<char>(value);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

// The file that a glTF names, if it may be opened.
fs::path buffer_path(const std::string& uri, const fs::path& folder) {
  const auto refuse = [&](const char* reason) {
    throw Error(ErrorCode::input, fmt::format("its buffer '{}' {}; a buffer must be a regular file in the "
                                              "glTF's own folder (or export a .glb, which holds everything)",
                                              uri.substr(0, 200), reason));
  };
  if (uri.find("://") != uri.npos) refuse("is an address, and nothing is fetched");
  const fs::path path = percent_decoded(uri);
  if (path.is_absolute()) refuse("is an absolute path");
  if (folder.empty()) refuse("lies in another file");
  std::error_code missing;
  const fs::path file = fs::canonical(folder / path, missing);
  if (missing) refuse("is missing");
  const fs::path inside = file.lexically_relative(fs::canonical(folder));
  if (inside.empty() || *inside.begin() == "..") refuse("lies outside the folder");
  if (!fs::is_regular_file(file)) refuse("is no regular file");
  return file;
}

}  // namespace

MeshFolder::MeshFolder(std::string_view bytes, std::string name, fs::path folder)
    : bytes_(bytes), name_(std::move(name)), folder_(std::move(folder)) {}

Assimp::IOStream* MeshFolder::Open(const char* path, const char*) {
  if (path == name_) return stream_of(bytes_);
  const std::string extension = extension_of(name_);
  if (extension != ".gltf" && extension != ".glb") return nullptr;
  return stream_of(others_.emplace_back(read_file(buffer_path(path, folder_).string())));
}

void MeshFolder::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace wilt::detail
