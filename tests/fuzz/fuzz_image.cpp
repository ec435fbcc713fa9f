// PNG and JPEG pictures of at most 16,384 pixels by their header, so that one takes no long time to decode.
#include "fuzz/contract.hpp"
#include "wilt/core/image_codec.hpp"

namespace {

// Whether a PNG's header or a JPEG's frame header states few pixels; true when there is none.
bool is_small(std::string_view bytes) {
  const auto u16 = [&](std::size_t at) {
    return at + 1 < bytes.size()
               ? static_cast<std::uint8_t>(bytes[at]) << 8 | static_cast<std::uint8_t>(bytes[at + 1])
               : 0;
  };
  const auto few = [](double width, double height) { return width * height <= 16384; };
  if (bytes.substr(0, 2) != "\xff\xd8")
    return few(std::int64_t(u16(16)) << 16 | u16(18), std::int64_t(u16(20)) << 16 | u16(22));
  for (std::size_t at = 2; (at = bytes.find('\xff', at)) != bytes.npos; ++at) {
    const int marker = u16(at) & 0xff;
    if (marker >= 0xc0 && marker <= 0xc2 && !few(u16(at + 7), u16(at + 5))) return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  const std::string_view bytes = fuzz::text_of(data, size);
  if (!is_small(bytes)) return 0;
  const auto image = fuzz::unless_refused([&] { return decode_image(bytes); });
  if (!image) return 0;
  const auto pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  fuzz::require(pixels > 0 && image->rgb.size() == 3 * pixels, "three bytes for every pixel");
  const auto alpha = fuzz::unless_refused([&] { return decode_alpha(bytes); });
  fuzz::require(alpha && (alpha->empty() || alpha->size() == pixels), "an opacity for every pixel, or none");
  if (pixels > 1024) return 0;
  fuzz::require(decode_image(encode_png(*image)).rgb == image->rgb, "a PNG gives the same pixels back");
  return 0;
}
