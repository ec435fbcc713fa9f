// Numbers as the bytes of a binary file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace wilt {

/// Appends a number, lowest byte first, on any machine.
template <class Number>
void append_little_endian(std::string& bytes, Number number) {
  static_assert(sizeof(Number) <= sizeof(std::uint64_t));
  if constexpr (sizeof(Number) == 4) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, 4);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  } else if constexpr (sizeof(Number) == 8) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, 8);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  } else {
    static_assert(sizeof(Number) == 1);
    bytes += static_cast<char>(number);
  }
}

/// Appends a number of four bytes, highest byte first, on any machine.
template <class Number>
void append_big_endian(std::string& bytes, Number number) {
  static_assert(sizeof(Number) == 4);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, 4);
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

/// The number of four bytes at `at`, which lies within.
template <class Number>
Number number_at(std::string_view bytes, std::size_t at, bool big_endian) {
  static_assert(sizeof(Number) == 4);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + i]);
    bits |= std::uint32_t{byte} << (8 * (big_endian ? 3 - i : i));
  }
  Number number;
  std::memcpy(&number, &bits, 4);
  return number;
}

}  // namespace wilt
