#include "wilt/batch/distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/core/random.hpp"

namespace wilt::detail {
namespace {

struct Named {
  const char* name;
  Spread spread;
};
constexpr std::array<Named, 5> kSpreads = {{{"choice", Spread::choice},
                                            {"grid", Spread::grid},
                                            {"latin", Spread::latin},
                                            {"normal", Spread::normal},
                                            {"uniform", Spread::uniform}}};
constexpr const char* kForms =
    "{uniform = [a, b]}, {normal = [mean, deviation]}, {latin = [a, b]}, {choice = [...]} or {grid = [...]}";

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

std::optional<std::string> scalar_text(const toml::node& node) {
  if (node.is_string()) return *node.value<std::string>();
  if (node.is_boolean()) return *node.value<bool>() ? "true" : "false";
  if (node.is_integer()) return fmt::format("{}", *node.value<std::int64_t>());
  if (node.is_floating_point()) return fmt::format("{}", *node.value<double>());
  return std::nullopt;
}

const toml::array& list_of(const std::string& key, const char* name, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) fail(fmt::format("{}: {} takes a list, [...]", key, name));
  return *list;
}

std::vector<double> numbers_of(const std::string& key, const char* name, const toml::node& node) {
  std::vector<double> numbers;
  for (const toml::node& entry : list_of(key, name, node)) {
    const std::optional<double> number = entry.value<double>();
    if (!number || !std::isfinite(*number)) fail(fmt::format("{}: {} takes a list of numbers", key, name));
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::string> words_of(const std::string& key, const char* name, const toml::node& node) {
  std::vector<std::string> words;
  for (const toml::node& entry : list_of(key, name, node)) {
    const std::optional<std::string> word = scalar_text(entry);
    if (!word) fail(fmt::format("{}: {} takes a list of words or numbers", key, name));
    words.push_back(*word);
  }
  return words;
}

void read_pair(Distribution& result, const std::string& key, const char* name, const toml::node& node) {
  const std::vector<double> pair = numbers_of(key, name, node);
  if (pair.size() != 2) fail(fmt::format("{}: {} takes two numbers, not {}", key, name, pair.size()));
  result.a = pair[0], result.b = pair[1];
  if (result.spread == Spread::normal ? result.b < 0.0 : result.b < result.a)
    fail(fmt::format("{}: {}", key,
                     result.spread == Spread::normal
                         ? fmt::format("the deviation is {}; it is 0 or more", result.b)
                         : fmt::format("{} goes from {} to {}; the smaller number comes first", name,
                                       result.a, result.b)));
}

void read_weights(Distribution& result, const std::string& key, const toml::node& node) {
  result.weights = numbers_of(key, "weights", node);
  const bool positive =
      std::all_of(result.weights.begin(), result.weights.end(), [](double w) { return w > 0.0; });
  if (result.weights.size() != result.values.size() || !positive)
    fail(fmt::format("{}: weights takes a number above 0 for each of the {} choices", key,
                     result.values.size()));
}

double number_of(const std::string& key, const std::string& name, const toml::node& node) {
  const std::optional<double> number = node.value<double>();
  if (!number) fail(fmt::format("{}: {} takes a number", key, name));
  return *number;
}

std::string text_of(double value, bool whole) {
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
}

// u in [0, 1) over the range; a whole number takes its share of it.
std::string spread_over(const Distribution& d, double u) {
  if (!d.whole) return text_of(d.a + (d.b - d.a) * u, false);
  return text_of(std::min(d.b, d.a + std::floor((d.b - d.a + 1.0) * u)), true);
}

std::string draw_normal(const Distribution& d, Random& random) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    const double value = d.a + d.b * random.normal(), kept = d.whole ? std::round(value) : value;
    if (kept >= d.least && kept <= d.most) return text_of(kept, d.whole);
  }
  return text_of(std::clamp(d.a, d.least, d.most), d.whole);
}

const std::string& choose(const Distribution& d, Random& random) {
  if (d.weights.empty()) return d.values[random.index(static_cast<int>(d.values.size()))];
  double left = random.uniform(0.0, std::accumulate(d.weights.begin(), d.weights.end(), 0.0));
  std::size_t k = 0;
  while (k + 1 < d.weights.size() && left >= d.weights[k]) left -= d.weights[k++];
  return d.values[k];
}

}  // namespace

bool is_distribution(const toml::table& table) {
  return std::any_of(kSpreads.begin(), kSpreads.end(),
                     [&table](const Named& named) { return table.contains(named.name); });
}

Distribution parse_distribution(const std::string& key, const toml::node& node) {
  Distribution result;
  result.least = -std::numeric_limits<double>::infinity();
  result.most = std::numeric_limits<double>::infinity();
  if (const std::optional<std::string> text = scalar_text(node)) {
    result.values = {*text};
    return result;
  }
  const toml::table* table = node.as_table();
  if (table == nullptr || !is_distribution(*table))
    fail(fmt::format("{} takes one value, or how it varies: {}", key, kForms));
  for (const Named& named : kSpreads) {
    const toml::node* given = table->get(named.name);
    if (given == nullptr) continue;
    if (result.spread != Spread::fixed)
      fail(fmt::format("{} varies in two ways; give one of {}", key, kForms));
    result.spread = named.spread;
    if (named.spread == Spread::choice || named.spread == Spread::grid) {
      result.values = words_of(key, named.name, *given);
    } else {
      read_pair(result, key, named.name, *given);
    }
  }
  for (const auto& [name, value] : *table) {
    const std::string word(name.str());
    const bool is_form = std::any_of(kSpreads.begin(), kSpreads.end(),
                                     [&word](const Named& named) { return word == named.name; });
    if (is_form) continue;
    if (word == "weights" && result.spread == Spread::choice) {
      read_weights(result, key, value);
    } else if (word == "min" && result.spread == Spread::normal) {
      result.least = number_of(key, word, value);
    } else if (word == "max" && result.spread == Spread::normal) {
      result.most = number_of(key, word, value);
    } else {
      fail(fmt::format("{}: '{}' does not belong there; weights goes with choice, min and max with normal",
                       key, word));
    }
  }
  return result;
}

std::string draw(const Distribution& d, const std::string& key, std::uint64_t seed, int item,
                 std::size_t cell, int stratum, int strata) {
  if (d.spread == Spread::fixed) return d.values.front();
  if (d.spread == Spread::grid) return d.values[cell];
  Random random(seed, fmt::format("item {} {}", item, key));
  switch (d.spread) {
    case Spread::uniform:
      return spread_over(d, random.uniform());
    case Spread::latin:
      return spread_over(d, (stratum + random.uniform()) / strata);
    case Spread::normal:
      return draw_normal(d, random);
    default:
      return choose(d, random);
  }
}

}  // namespace wilt::detail
