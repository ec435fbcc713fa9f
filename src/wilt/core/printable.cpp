#include "wilt/core/printable.hpp"

#include <cstddef>
#include <cstdint>

namespace wilt {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

// The bytes of the character that begins at `at` (Unicode, table 3-7); 0 when they are none.
std::size_t length_of_character(std::string_view text, std::size_t at) {
  const unsigned first = byte_at(text, at), second = byte_at(text, at + 1);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0 ? 2 : first < 0xE0 ? 0 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4) return 0;
  const unsigned low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (second < low || second > high) return 0;
  for (std::size_t k = 2; k < length; ++k) {
    if (byte_at(text, at + k) < 0x80 || byte_at(text, at + k) > 0xBF) return 0;
  }
  return length;
}

// Of one or two bytes: C0, DEL and C1.
bool is_control(std::string_view character) {
  const unsigned first = byte_at(character, 0);
  return (first < 0x20 && first != '\t') || first == 0x7F || (first == 0xC2 && byte_at(character, 1) < 0xA0);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(text, at);
    const std::string_view character = text.substr(at, length);
    if (length == 0)
      clean += kReplacement;
    else if (is_control(character))
      clean += '?';
    else
      clean += character;
    at += length == 0 ? 1 : length;
  }
  return clean;
}

std::string_view untagged(std::string_view what) {
  const std::size_t end = what.find("] ");
  return what.substr(0, 1) == "[" && end != what.npos ? what.substr(end + 2) : what;
}

}  // namespace wilt
