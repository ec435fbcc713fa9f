// What every fuzz target asks of a parser: whatever the bytes are, it refuses them with wilt::Error or
// returns something whole. A sanitizer's finding, any other exception and a claim that does not hold end the
// program, and libFuzzer keeps the input.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <type_traits>

#include "wilt/core/error.hpp"

namespace wilt::fuzz {

/// Ends the program unless `holds`.
inline void require(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", claim);
  std::abort();
}

/// What `parse` returns, or nothing when it refuses with wilt::Error.
template <class Parse>
std::optional<std::invoke_result_t<Parse>> unless_refused(Parse&& parse) {
  try {
    return parse();
  } catch (const Error& error) {
    require(*error.what() != '\0', "a refusal says why");
    return std::nullopt;
  }
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Takes numbers off the front of an input; zeros when it has ended.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  std::size_t left() const { return left_; }
  int byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  int signed_byte() { return static_cast<std::int8_t>(byte()); }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace wilt::fuzz
