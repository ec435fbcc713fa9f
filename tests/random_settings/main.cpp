// random_settings SEED FIRST COUNT: a line of JSON for each of these runs, as soon as it is done.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "random_settings/outcome.hpp"

namespace wilt::random_settings {
namespace {

std::string line_of(const Draw& draw, const Outcome& o, double seconds) {
  const nlohmann::ordered_json line = {{"run", draw.number},           {"species", draw.config.species},
                                       {"model", draw.config.model},   {"way", way_name(draw.way)},
                                       {"settings", draw.assignments}, {"outcome", o.kind},
                                       {"reason", o.reason},           {"steps", o.steps},
                                       {"halved", o.halved},           {"residual", o.residual},
                                       {"tolerance", o.tolerance},     {"imbalance", o.imbalance},
                                       {"strain", o.strain},           {"motion", o.motion},
                                       {"energy", o.energy},           {"seconds", seconds}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
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
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run(drawn);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{}\n", line_of(drawn, outcome, seconds));
    std::fflush(stdout);
  }
  return 0;
}
