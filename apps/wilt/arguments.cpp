#include "arguments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "wilt/core/error.hpp"

namespace wilt::cli {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw Error(ErrorCode::configuration, fmt::format("{}, not '{}'", what, text));
}

}  // namespace

Vec2 parse_pair(const std::string& text, char separator, const std::string& what) {
  char* end = nullptr;
  const double first = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == separator) {
    const char* second = end + 1;
    const double value = std::strtod(second, &end);
    if (end != second && *end == '\0' && std::isfinite(first) && std::isfinite(value)) return {first, value};
  }
  refuse(text, what);
}

PixelSize parse_size(const std::string& text, const std::string& what) {
  const Vec2 size = parse_pair(text, 'x', what);
  for (const double side : size) {
    if (side != std::floor(side) || std::abs(side) > std::numeric_limits<int>::max()) refuse(text, what);
  }
  return {static_cast<int>(size.x()), static_cast<int>(size.y())};
}

}  // namespace wilt::cli
