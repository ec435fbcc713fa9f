#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "wilt/core/error.hpp"
#include "wilt/output/file.hpp"
#include "wilt/render/image.hpp"

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace wilt {

Image decode_image(std::string_view bytes) {
  int width = 0, height = 0, channels = 0;
  const auto size = static_cast<int>(std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max()));
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), size, &width, &height, &channels,
                            3),
      stbi_image_free);
  if (!pixels)
    throw Error(ErrorCode::input, fmt::format("the picture cannot be decoded ({}); it must be PNG or JPEG",
                                              stbi_failure_reason()));
  const std::size_t count = 3 * std::size_t(width) * std::size_t(height);
  return {width, height, {pixels.get(), pixels.get() + count}};
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      image.rgb.size() != 3 * std::size_t(image.width) * image.height) {
    throw Error(ErrorCode::input,
                fmt::format("picture: {} x {} pixels with {} bytes; 3 for each pixel are needed", image.width,
                            image.height, image.rgb.size()));
  }
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
    out.insert(out.end(), begin, begin + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(),
                              3 * image.width))
    throw Error(ErrorCode::output, "picture: PNG could not be encoded (out of memory?)");
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  write_file(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace wilt
