#include <fmt/format.h>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {

VeinsWriter veins_writer(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".json") return veins_json;
  if (extension == ".svg") return veins_svg;
  if (extension == ".obj") return veins_obj;
  throw Error(ErrorCode::configuration,
              fmt::format("cannot write '{}': veins are .json, .svg or .obj", path));
}

}  // namespace wilt
