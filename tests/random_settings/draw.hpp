// Random configurations: what scripts/random-settings runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wilt/simulation/config.hpp"

namespace wilt::random_settings {

/// How the settings of a run are drawn.
///
/// - all: every key anywhere in its range (numbers whose range spans decades by their logarithm), one in ten
///   at an end
/// - some: five keys like that, the rest as the species has them
/// - ends: every key at one of its ends
/// - one: one key at one of its ends
/// - near: every key between half and twice its default: what people try
enum class Way { all, some, ends, one, near };
const char* way_name(Way way);

struct Draw {
  std::int64_t number = 0;
  Way way = Way::all;
  std::vector<std::string> assignments;  ///< "key=value", as --set takes them, in the order of the table
  Config config;
};

/// The `number`-th run of a seed; it depends on nothing else. Species, model, 200 to 600 vertices and 5 to 30
/// iterations (one run in a hundred: 2000 and 100) come first. Throws what set() throws.
Draw draw(std::uint64_t seed, std::int64_t number);

}  // namespace wilt::random_settings
