// Counts in JSON documents of unknown origin.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace wilt {

/// The number, if `value` (of nlohmann's JSON) is a whole one that an int holds and not below 0. The library
/// itself converts any number, those beyond a type's range to anything.
template <class Json>
std::optional<int> whole_number(const Json& value) {
  if (!value.is_number_integer()) return std::nullopt;
  const auto number = value.template get<std::int64_t>();  // one beyond it comes out negative
  if (number < 0 || number > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(number);
}

}  // namespace wilt
