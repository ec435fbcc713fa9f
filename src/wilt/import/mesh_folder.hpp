// What the mesh library may open. Inside the import room only.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include <assimp/IOSystem.hpp>

namespace wilt::detail {

/// A mesh file's bytes under a name, and for a glTF the buffers beside it: regular files in the file's folder
/// or below, once symbolic links are followed, each of kLargestFile bytes at most. Nothing else is opened: no
/// absolute path, no way out through "..", no address of the network; of an OBJ no material library, as wilt
/// has no use for materials. Opening what is not allowed or not there throws Error{input} for a glTF.
class MeshFolder : public Assimp::IOSystem {
 public:
  /// `bytes` must live as long as this; an empty `folder` allows no other file.
  MeshFolder(std::string_view bytes, std::string name, std::filesystem::path folder);

  bool Exists(const char* path) const override { return path == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  std::string_view bytes_;
  std::string name_;
  std::filesystem::path folder_;
  std::deque<std::string> others_;  // what was read; a deque leaves its strings in their places
};

}  // namespace wilt::detail
