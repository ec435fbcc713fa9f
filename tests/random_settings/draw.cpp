#include "random_settings/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "wilt/core/random.hpp"

namespace wilt::random_settings {
namespace {

// How long a run takes, and what it is a run of: drawn apart. Nobody knows the number of tips before.
const std::set<std::string> kApart = {"model",      "species",      "vertices",
                                      "iterations", "texture.size", "external.forces"};

template <class T>
const T& pick(const std::vector<T>& values, Random& random) {
  return values[static_cast<std::size_t>(random.index(static_cast<int>(values.size())))];
}

bool whole(const Setting& setting, Config& config) {
  return std::holds_alternative<std::int64_t*>(setting.field(config));
}

double number_of(const Setting& setting, Config& config) {
  const Setting::Field field = setting.field(config);
  if (auto* const* integer = std::get_if<std::int64_t*>(&field)) return static_cast<double>(**integer);
  return **std::get_if<double*>(&field);
}

// Between two ends: by the logarithm where the range spans decades, half of the time so where it begins at 0.
double between(double low, double high, Random& random) {
  constexpr double kDecades = 1e-6;
  const bool from_zero = low == 0.0;
  if (low < 0.0 || (from_zero ? random.index(2) == 0 : high / low < 100.0)) return random.uniform(low, high);
  return std::exp(random.uniform(std::log(from_zero ? kDecades * high : low), std::log(high)));
}

std::string text_of(double value, bool whole) {
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
}

// The words of a setting, or true and false; none for a number.
std::vector<std::string> words_of(const Setting& setting, Config& config) {
  const Setting::Field field = setting.field(config);
  return std::holds_alternative<bool*>(field) ? std::vector<std::string>{"true", "false"} : setting.words;
}

// A polygon within the leaf's reach, or none.
std::string region_of(Random& random) {
  const int corners = random.index(4) == 0 ? 0 : 3 + random.index(6);
  std::vector<std::string> places;
  for (int k = 0; k < 2 * corners; ++k) places.push_back(text_of(random.uniform(-1.0, 1.0), false));
  return fmt::format("{}", fmt::join(places, ","));
}

bool is_list(const Setting& setting, Config& config) {
  return std::holds_alternative<std::vector<double>*>(setting.field(config));
}

std::string at_an_end(const Setting& setting, Config& config, Random& random) {
  if (is_list(setting, config)) return region_of(random);
  if (const auto words = words_of(setting, config); !words.empty()) return pick(words, random);
  return text_of(random.index(2) == 0 ? setting.min : setting.max, whole(setting, config));
}

std::string anywhere(const Setting& setting, Config& config, Random& random) {
  if (is_list(setting, config)) return region_of(random);
  if (const auto words = words_of(setting, config); !words.empty()) return pick(words, random);
  if (random.index(10) == 0) return at_an_end(setting, config, random);
  return text_of(between(setting.min, setting.max, random), whole(setting, config));
}

std::string near_default(const Setting& setting, Config& config, Random& random) {
  if (is_list(setting, config)) return region_of(random);
  if (const auto words = words_of(setting, config); !words.empty()) return pick(words, random);
  const double value = number_of(setting, config) * std::exp(random.uniform(-std::log(2.0), std::log(2.0)));
  return text_of(std::clamp(value, setting.min, setting.max), whole(setting, config));
}

std::vector<const Setting*> drawn_settings() {
  std::vector<const Setting*> keys;
  for (const Setting& setting : settings()) {
    if (kApart.count(setting.key) == 0) keys.push_back(&setting);
  }
  return keys;
}

Way way_of(std::int64_t number) {
  constexpr std::array<Way, 10> kShares = {Way::all,  Way::near, Way::some, Way::one,  Way::near,
                                           Way::some, Way::ends, Way::one,  Way::near, Way::all};
  return kShares[static_cast<std::size_t>(number % 10)];
}

class Drawing {
 public:
  explicit Drawing(Draw& draw) : draw_(draw) {}

  void assign(const std::string& key, const std::string& value) {
    draw_.assignments.push_back(key + "=" + value);
    set(draw_.config, key, value);
  }
  void assign(const Setting& setting, std::string (*choose)(const Setting&, Config&, Random&),
              Random& random) {
    assign(setting.key, choose(setting, draw_.config, random));
  }

 private:
  Draw& draw_;
};

// One run in a hundred is as large as people's.
void draw_size(Drawing& drawing, std::int64_t number, Random& random) {
  const bool large = number % 100 == 57;
  drawing.assign("vertices", large ? "2000" : text_of(between(200, 600, random), true));
  drawing.assign("iterations", large ? "100" : text_of(random.uniform(5, 30), true));
  drawing.assign("texture.size", random.index(4) == 0 ? "0" : text_of(random.uniform(16, 128), true));
}

// Most runs have their masses in order; else half of them would be refused for that alone.
void order_masses(Drawing& drawing, const Config& config, Random& random) {
  if (config.mass.min <= config.mass.max || random.index(10) == 0) return;
  const double least = config.mass.max, most = config.mass.min;
  drawing.assign("mass.min", text_of(least, false));
  drawing.assign("mass.max", text_of(most, false));
}

void draw_settings(Drawing& drawing, Way way, Random& random) {
  const std::vector<const Setting*> keys = drawn_settings();
  if (way == Way::one) return drawing.assign(*pick(keys, random), at_an_end, random);
  if (way == Way::some) {
    std::set<const Setting*> chosen;
    while (chosen.size() < 5) chosen.insert(pick(keys, random));
    for (const Setting* key : keys) {
      if (chosen.count(key) > 0) drawing.assign(*key, anywhere, random);
    }
    return;
  }
  for (const Setting* key : keys)
    drawing.assign(*key, way == Way::all ? anywhere : way == Way::ends ? at_an_end : near_default, random);
}

}  // namespace

const char* way_name(Way way) {
  constexpr std::array<const char*, 5> kNames = {"all", "some", "ends", "one", "near"};
  return kNames[static_cast<std::size_t>(way)];
}

Draw draw(std::uint64_t seed, std::int64_t number) {
  Random random(seed, fmt::format("random settings {}", number));
  Draw result;
  result.number = number;
  result.way = way_of(number);
  const std::string name = pick(species_names(), random);
  result.config = default_config(species(name));
  result.assignments.push_back("species=" + name);
  Drawing drawing(result);
  drawing.assign("model", random.index(2) == 0 ? "cell" : "paper");
  draw_size(drawing, number, random);
  draw_settings(drawing, result.way, random);
  order_masses(drawing, result.config, random);
  return result;
}

}  // namespace wilt::random_settings
