#include "wilt/batch/toml_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt::detail {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& source) {
  check_toml_keys(text, source);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    fail(fmt::format("{}, line {}: this is not TOML ({})", source, error.source().begin.line,
                     error.description()));
  }
}

void for_each_key(const toml::table& table, const std::string& source, const Take& take) {
  for (const auto& [name, value] : table) {
    const std::string place = fmt::format("{}, line {}: ", source, value.source().begin.line);
    try {
      take(std::string(name.str()), value);
    } catch (const Error& error) {
      const bool placed = std::string_view(error.what()).substr(0, source.size()) == source;
      if (error.code() != ErrorCode::configuration || placed) throw;
      fail(place + error.what());
    }
  }
}

void take_section(const toml::node& node, const std::string& section, const std::string& source,
                  const std::map<std::string, Take>& takers) {
  const toml::table* table = node.as_table();
  if (table == nullptr) fail(fmt::format("[{}] is a section with keys of its own", section));
  std::vector<std::string> known;
  for (const auto& [key, take] : takers) known.push_back(key);
  for_each_key(*table, source, [&](const std::string& key, const toml::node& value) {
    const auto found = takers.find(key);
    if (found == takers.end())
      fail(fmt::format("unknown key '{}'{}; {} has {}", key, did_you_mean(key, known),
                       section.empty() ? "a plan" : fmt::format("[{}]", section), fmt::join(known, ", ")));
    found->second(key, value);
  });
}

std::int64_t whole_number(const std::string& key, const toml::node& node, std::int64_t least,
                          std::int64_t most) {
  const std::optional<std::int64_t> value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most)
    fail(fmt::format("{} must be a whole number from {} to {}", key, least, most));
  return *value;
}

double number(const std::string& key, const toml::node& node, double least, double most) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= least && *value <= most))
    fail(fmt::format("{} must be a number from {} to {}", key, least, most));
  return *value;
}

bool flag(const std::string& key, const toml::node& node) {
  if (!node.is_boolean()) fail(fmt::format("{} must be true or false", key));
  return *node.value<bool>();
}

std::string word(const std::string& key, const toml::node& node) {
  if (!node.is_string()) fail(fmt::format("{} must be text in quotes", key));
  return *node.value<std::string>();
}

const toml::array& pair(const std::string& key, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) fail(fmt::format("{} takes two numbers, [a, b]", key));
  return *list;
}

std::vector<std::string> words(const std::string& key, const toml::node& node,
                               const std::vector<std::string>& allowed) {
  std::vector<std::string> list;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& entry : *array) list.push_back(word(key, entry));
  } else {
    list.push_back(word(key, node));
  }
  for (const std::string& entry : list) {
    if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), entry) == allowed.end())
      fail(fmt::format("{} takes {}, not '{}'{}", key, fmt::join(allowed, ", "), entry,
                       did_you_mean(entry, allowed)));
  }
  return list;
}

}  // namespace wilt::detail
