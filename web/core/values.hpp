// Between JavaScript's values and ours. Arrays are copied both ways: what JavaScript sees of the module's
// memory moves when that grows.
#pragma once

#include <emscripten/val.h>

#include <cstdint>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::web {

using emscripten::val;

inline const char* array_type(float) {
  return "Float32Array";
}
inline const char* array_type(double) {
  return "Float64Array";
}
inline const char* array_type(std::uint32_t) {
  return "Uint32Array";
}
inline const char* array_type(std::uint8_t) {
  return "Uint8Array";
}

/// A typed array of JavaScript's own.
template <class Number>
val typed(const std::vector<Number>& values) {
  return val::global(array_type(Number{})).new_(emscripten::typed_memory_view(values.size(), values.data()));
}

inline val bytes(const std::string& text) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(text.data());
  return val::global("Uint8Array").new_(emscripten::typed_memory_view(text.size(), first));
}

/// A plain array.
inline val numbers(const std::vector<double>& values) {
  return val::array(values.begin(), values.end());
}

inline std::vector<double> doubles(const val& array) {
  return emscripten::convertJSArrayToNumberVector<double>(array);
}

/// x, y of each point; throws Error{input} for half a point.
Points2 points2(const val& array);

}  // namespace wilt::web
