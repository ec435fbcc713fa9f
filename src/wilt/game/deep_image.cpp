#include "wilt/game/deep_image.hpp"

#include <fmt/format.h>
#include <lodepng.h>
#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr float kLargestHalf = 65504.0F;

[[noreturn]] void cannot_encode(const DeepImage& image, const char* format, const char* reason) {
  throw Error(ErrorCode::output, fmt::format("a texture of {} x {} texels cannot be encoded as {}: {}",
                                             image.width, image.height, format, reason));
}

void check_size(const DeepImage& image) {
  WILT_CHECK(image.width >= 1 && image.height >= 1 &&
                 image.texels.rows() == Eigen::Index{image.width} * image.height,
             image.width, image.height, image.texels.rows());
}

}  // namespace

std::string encode_exr(const DeepImage& image) {
  check_size(image);
  if (!(image.texels.array().abs() <= kLargestHalf).all())
    cannot_encode(image, "EXR", "a value is beyond 65504, the largest half float");
  constexpr int kChannels = 3;
  constexpr std::array<const char*, kChannels> kNames{"B", "G", "R"};  // the format sorts them by name
  std::array<Eigen::VectorXf, kChannels> planes;
  std::array<unsigned char*, kChannels> data{};
  std::array<EXRChannelInfo, kChannels> channels{};
  std::array<int, kChannels> from{}, to{};
  for (std::size_t c = 0; c < kChannels; ++c) {
    planes[c] = image.texels.col(kChannels - 1 - static_cast<Eigen::Index>(c));
    data[c] = reinterpret_cast<unsigned char*>(planes[c].data());
    std::strcpy(channels[c].name, kNames[c]);
    from[c] = TINYEXR_PIXELTYPE_FLOAT;
    to[c] = TINYEXR_PIXELTYPE_HALF;
  }
  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = kChannels;
  header.channels = channels.data();
  header.pixel_types = from.data();
  header.requested_pixel_types = to.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage picture;
  InitEXRImage(&picture);
  picture.num_channels = kChannels;
  picture.images = data.data();
  picture.width = image.width;
  picture.height = image.height;
  unsigned char* memory = nullptr;
  const char* reason = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&picture, &header, &memory, &reason);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
  if (size == 0) cannot_encode(image, "EXR", reason != nullptr ? reason : "unknown");
  return {reinterpret_cast<const char*>(memory), size};
}

std::string encode_png16(const DeepImage& image) {
  check_size(image);
  std::vector<unsigned char> bytes;  // the high byte first
  bytes.reserve(static_cast<std::size_t>(image.texels.size()) * 2);
  for (Eigen::Index i = 0; i < image.texels.size(); ++i) {
    const double value = std::clamp(image.texels.data()[i], 0.0F, 1.0F);
    const auto level = static_cast<unsigned>(std::lround(65535.0 * value));
    bytes.push_back(static_cast<unsigned char>(level >> 8));
    bytes.push_back(static_cast<unsigned char>(level & 0xff));
  }
  lodepng::State state;
  state.encoder.auto_convert = 0;  // left to itself it writes 8 bits of 16 where that loses nothing
  for (LodePNGColorMode* mode : {&state.info_raw, &state.info_png.color})
    mode->colortype = LCT_RGB, mode->bitdepth = 16;
  std::vector<unsigned char> png;
  const unsigned error = lodepng::encode(png, bytes, static_cast<unsigned>(image.width),
                                         static_cast<unsigned>(image.height), state);
  if (error != 0) cannot_encode(image, "PNG", lodepng_error_text(error));
  return {png.begin(), png.end()};
}

}  // namespace wilt
