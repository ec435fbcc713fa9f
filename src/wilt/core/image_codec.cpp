#include "wilt/core/image_codec.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/jpeg_tables.hpp"

// Ours alone (static): other sources, and tinygltf, may hold theirs.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace wilt {
namespace {

// A file of some kilobytes may claim to be a picture of any size.
constexpr std::int64_t kMostPixels = 250'000'000;

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

[[noreturn]] void cannot_decode() {
  const std::string_view reason = stbi_failure_reason();
  throw Error(ErrorCode::input, fmt::format("the picture cannot be read ({}); give a PNG or a JPEG",
                                            reason.empty() ? "it is damaged" : reason));
}

const stbi_uc* data_of(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}

// How many channels a picture has; its size, which must be one that memory can be had for.
int channels_of(std::string_view bytes, int& width, int& height) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(ErrorCode::input, "the picture is larger than 2 GB");
  int channels = 0;
  if (!stbi_info_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &width, &height, &channels))
    cannot_decode();
  if (std::int64_t{width} * height > kMostPixels)
    throw Error(ErrorCode::input,
                fmt::format("the picture has {} x {} pixels; {} million are allowed: scale it down", width,
                            height, kMostPixels / 1'000'000));
  return channels;
}

struct FreePixels {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};
using Pixels = std::unique_ptr<stbi_uc, FreePixels>;

// Rows of `channels` bytes a pixel.
Pixels decode(std::string_view bytes, int channels, int& width, int& height) {
  if (bytes.starts_with('\xff')) detail::check_jpeg_tables(bytes);
  int found = channels_of(bytes, width, height);
  Pixels pixels(stbi_load_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &width, &height, &found,
                                      channels));
  if (!pixels) cannot_decode();
  return pixels;
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
  const Pixels pixels = decode(bytes, 3, image.width, image.height);
  image.rgb.assign(pixels.get(), pixels.get() + 3 * std::size_t(image.width) * std::size_t(image.height));
  return image;
}

std::vector<std::uint8_t> decode_alpha(std::string_view bytes) {
  int width = 0, height = 0;
  const int channels = channels_of(bytes, width, height);
  if (channels != 2 && channels != 4) return {};
  const Pixels pixels = decode(bytes, 2, width, height);
  std::vector<std::uint8_t> alpha(std::size_t(width) * std::size_t(height));
  for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = pixels.get()[2 * i + 1];
  return alpha;
}

bool is_jpeg(std::string_view bytes) {
  return bytes.substr(0, 2) == "\xff\xd8";
}

Image resized(const Image& image, int width, int height) {
  check_size(image);
  if (image.width == width && image.height == height) return image;
  Image result{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height)};
  const int done = stbir_resize_uint8_srgb(image.rgb.data(), image.width, image.height, 0, result.rgb.data(),
                                           width, height, 0, 3, STBIR_ALPHA_CHANNEL_NONE, 0);
  WILT_CHECK(done == 1, width, height);
  return result;
}

}  // namespace wilt
