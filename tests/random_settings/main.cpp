// random_settings SEED FIRST COUNT: for each of these runs a line of JSON when it begins, with its settings,
// and one when it is done.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "random_settings/outcome.hpp"

namespace wilt::random_settings {
namespace {

using Line = nlohmann::ordered_json;

void print(const Line& line) {
  fmt::print("{}\n", line.dump(-1, ' ', false, Line::error_handler_t::replace));
  std::fflush(stdout);
}

Line beginning_of(const Draw& draw) {
  return {{"run", draw.number},
          {"species", draw.config.species},
          {"model", draw.config.model},
          {"way", way_name(draw.way)},
          {"settings", draw.assignments}};
}

Line end_of(const Draw& draw, const Outcome& o, double seconds) {
  return {{"run", draw.number}, {"outcome", o.kind},      {"reason", o.reason},       {"steps", o.steps},
          {"halved", o.halved}, {"residual", o.residual}, {"imbalance", o.imbalance}, {"strain", o.strain},
          {"motion", o.motion}, {"energy", o.energy},     {"seconds", seconds}};
}

}  // namespace
}  // namespace wilt::random_settings

int main(int argc, char** argv) {
  using namespace wilt::random_settings;
  if (argc != 4) {
    std::fputs("usage: random_settings SEED FIRST COUNT\n", stderr);
    return 2;
  }
  const std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  const std::int64_t first = std::strtoll(argv[2], nullptr, 10), count = std::strtoll(argv[3], nullptr, 10);
  for (std::int64_t number = first; number < first + count; ++number) {
    const Draw drawn = draw(seed, number);
    print(beginning_of(drawn));
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run(drawn);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print(end_of(drawn, outcome, seconds));
  }
  return 0;
}
