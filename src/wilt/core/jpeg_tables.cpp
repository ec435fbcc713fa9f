#include "wilt/core/jpeg_tables.hpp"

#include <fmt/format.h>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

constexpr int kTables = 0xc4, kRestart = 0xd0, kStart = 0xd8, kEnd = 0xd9;
constexpr int kMostCodes = 256;
constexpr std::size_t kLengths = 16;

// A byte, 0 beyond the end, where decoders read zeros too.
std::size_t byte_at(std::string_view bytes, std::size_t at) {
  return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
}

// The tables from `at` to `end`: class and number, how many codes there are of each length, what they mean.
// Decoders read the counts of the last one to their end, whatever the segment's length is.
void check_tables(std::string_view jpeg, std::size_t at, std::size_t end) {
  while (at < end) {
    std::size_t codes = 0;
    for (std::size_t i = 1; i <= kLengths; ++i) codes += byte_at(jpeg, at + i);
    if (codes > kMostCodes)
      throw Error(ErrorCode::input,
                  fmt::format("the picture cannot be read: a table of the JPEG holds {} codes, {} are "
                              "allowed; save it again, as PNG or JPEG",
                              codes, kMostCodes));
    at += 1 + kLengths + codes;
  }
}

}  // namespace

void check_jpeg_tables(std::string_view jpeg) {
  for (std::size_t at = 0; (at = jpeg.find('\xff', at)) != jpeg.npos;) {
    const auto marker = static_cast<int>(byte_at(jpeg, at + 1));
    if (marker == kEnd) return;
    if (marker == 0xff) {  // padding
      ++at;
    } else if (marker == 0 || (marker >= kRestart && marker <= kStart)) {  // has no length
      at += 2;
    } else {
      const std::size_t length = byte_at(jpeg, at + 2) << 8 | byte_at(jpeg, at + 3);
      if (marker == kTables) check_tables(jpeg, at + 4, at + 2 + length);
      at += 2 + length;
    }
  }
}

}  // namespace wilt::detail
