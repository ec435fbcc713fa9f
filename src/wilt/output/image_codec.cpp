#include "wilt/output/image_codec.hpp"

#include <fmt/format.h>

#include <limits>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

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

std::string encode_jpeg(const Picture& picture, int quality) {
  const std::size_t pixels =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  WILT_CHECK(picture.width >= 1 && picture.height >= 1 && picture.rgb.size() == 3 * pixels, picture.width,
             picture.height, picture.rgb.size());
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (picture.width > 65535 || picture.height > 65535 ||
      !stbi_write_jpg_to_func(append, &bytes, picture.width, picture.height, 3, picture.rgb.data(), quality))
    throw Error(ErrorCode::output, fmt::format("a picture of {} x {} pixels cannot be encoded as JPEG",
                                               picture.width, picture.height));
  return bytes;
}

Picture decode_picture(std::string_view bytes) {
  Picture picture;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(ErrorCode::input, "the picture is larger than 2 GB");
  int channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()),
                            &picture.width, &picture.height, &channels, 3);
  if (pixels == nullptr)
    throw Error(ErrorCode::input,
                fmt::format("the picture cannot be read: {}; give a PNG or a JPEG", stbi_failure_reason()));
  const std::size_t count =
      3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  picture.rgb.assign(pixels, pixels + count);
  stbi_image_free(pixels);
  return picture;
}

}  // namespace wilt
