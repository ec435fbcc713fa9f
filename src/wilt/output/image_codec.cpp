#include "wilt/output/image_codec.hpp"

#include <fmt/format.h>

#include <limits>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/output/file.hpp"

// Ours alone (static): other sources, and tinygltf, may hold theirs.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace wilt {
namespace {

constexpr int kPictureQuality = 91;

// Collects what an encoder writes.
void append(void* bytes, void* data, int size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

void check_size(const Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  WILT_CHECK(image.width >= 1 && image.height >= 1 && image.rgb.size() == 3 * pixels, image.width,
             image.height, image.rgb.size());
}

[[noreturn]] void cannot_encode(const Image& image, const char* format) {
  throw Error(ErrorCode::output, fmt::format("a picture of {} x {} pixels cannot be encoded as {}",
                                             image.width, image.height, format));
}

}  // namespace

std::string encode_jpeg(const Image& image, int quality) {
  check_size(image);
  std::string bytes;
  if (image.width > 65535 || image.height > 65535 ||
      !stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), quality))
    cannot_encode(image, "JPEG");
  return bytes;
}

std::string encode_png(const Image& image) {
  check_size(image);
  std::string bytes;
  // The encoder counts bytes in an int.
  if ((3 * std::int64_t(image.width) + 1) * image.height > std::numeric_limits<int>::max() ||
      !stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(),
                              3 * image.width))
    cannot_encode(image, "PNG");
  return bytes;
}

Image decode_image(std::string_view bytes) {
  Image image;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(ErrorCode::input, "the picture is larger than 2 GB");
  int channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()),
                            &image.width, &image.height, &channels, 3);
  if (pixels == nullptr)
    throw Error(ErrorCode::input,
                fmt::format("the picture cannot be read: {}; give a PNG or a JPEG", stbi_failure_reason()));
  const std::size_t count =
      3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgb.assign(pixels, pixels + count);
  stbi_image_free(pixels);
  return image;
}

bool is_jpeg(std::string_view bytes) {
  return bytes.substr(0, 2) == "\xff\xd8";
}

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
