#include "wilt/output/picture_file.hpp"

#include <fmt/format.h>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"

namespace wilt {

constexpr int kPictureQuality = 91;

bool is_picture_path(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

void write_image(const std::string& path, const Image& image) {
  if (!is_picture_path(path))
    throw Error(ErrorCode::configuration,
                fmt::format("cannot write '{}': a picture is .png, .jpg or .jpeg", path));
  write_file(path, extension_of(path) == ".png" ? encode_png(image) : encode_jpeg(image, kPictureQuality));
}

}  // namespace wilt
