// Checks of our own invariants: a failure is a bug of wilt's, never of its input.
#pragma once

#include <sstream>
#include <string>

namespace wilt::detail {

/// Throws std::logic_error that names the expression, its operands and the place.
[[noreturn]] void check_failed(const char* expression, const std::string& operands, const char* file,
                               int line);

template <class... Operands>
std::string print_operands(const Operands&... operands) {
  std::ostringstream out;
  const char* separator = "";
  ((out << separator << operands, separator = ", "), ...);
  return out.str();
}

}  // namespace wilt::detail

/// WILT_CHECK(a < b, a, b) throws std::logic_error with the values of a and b when a < b does not hold.
#define WILT_CHECK(condition, ...)                                                                    \
  do {                                                                                                \
    if (!(condition))                                                                                 \
      ::wilt::detail::check_failed(#condition, ::wilt::detail::print_operands(__VA_ARGS__), __FILE__, \
                                   __LINE__);                                                         \
  } while (false)
