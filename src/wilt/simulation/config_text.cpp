// The configuration as text: TOML in and out, JSON out.
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "wilt/core/error.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/setting_values.hpp"

namespace wilt {
namespace {

constexpr const char* kChange = "change";

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

// Does what may fail because of a node; the message says where that stands.
template <class Action>
void at_line(const toml::node& node, std::string_view source, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    fail(fmt::format("{}, line {}: {}", source, node.source().begin.line, error.what()));
  }
}

const char* kind_of(const Setting::Field& field) {
  return detail::is_number(field)                              ? "a number"
         : std::holds_alternative<bool*>(field)                ? "true or false"
         : std::holds_alternative<std::vector<double>*>(field) ? "a list of numbers, [...]"
                                                               : "a word in quotes";
}

// The numbers of an array; none when one of its entries is something else.
std::optional<std::vector<double>> numbers_of(const toml::array& array) {
  std::vector<double> numbers;
  for (const toml::node& entry : array) {
    if (!entry.is_number()) return std::nullopt;
    numbers.push_back(*entry.value<double>());
  }
  return numbers;
}

// Returns whether the node is of the kind that the setting takes.
bool assign(Config& config, const Setting& setting, const toml::node& node) {
  const Setting::Field field = setting.field(config);
  if (detail::is_number(field) && node.is_number()) {
    detail::assign_number(setting, field, *node.value<double>());
    return true;
  }
  if (bool* const* flag = std::get_if<bool*>(&field); flag && node.is_boolean()) {
    **flag = *node.value<bool>();
    return true;
  }
  if (std::string* const* word = std::get_if<std::string*>(&field); word && node.is_string()) {
    detail::assign_word(setting, **word, *node.value<std::string>());
    return true;
  }
  auto* const* list = std::get_if<std::vector<double>*>(&field);
  if (list == nullptr || !node.is_array()) return false;
  std::optional<std::vector<double>> numbers = numbers_of(*node.as_array());
  if (numbers) detail::assign_list(setting, **list, std::move(*numbers));
  return numbers.has_value();
}

void apply_node(Config& config, const std::string& key, const toml::node& node) {
  const Setting& setting = detail::find_setting(key);
  if (!assign(config, setting, node)) fail(fmt::format("{} must be {}", key, kind_of(setting.field(config))));
}

// Calls action(dotted key, node) for every value of a table; what it throws names the line.
template <class Action>
void for_each_value(const toml::table& table, const std::string& prefix, std::string_view source,
                    const Action& action) {
  for (const auto& entry : table) {
    const std::string key = prefix + std::string(entry.first.str());
    const toml::node& node = entry.second;
    if (const toml::table* nested = node.as_table())
      for_each_value(*nested, key + ".", source, action);
    else
      at_line(node, source, [&] { action(key, node); });
  }
}

std::int64_t iteration_of(const toml::table& section) {
  const toml::node* node = section.get("iteration");
  if (node == nullptr) fail("a [[change]] has no iteration; add a line like iteration = 40");
  if (!node->is_integer()) fail("iteration must be a whole number");
  return *node->value<std::int64_t>();
}

void apply_change(Config& config, const toml::table& section, std::string_view source) {
  std::int64_t iteration = 0;
  at_line(section, source, [&] { iteration = iteration_of(section); });
  for_each_value(section, "", source, [&](const std::string& key, const toml::node& node) {
    if (key == "iteration") return;
    Config changed = config;
    apply_node(changed, key, node);
    add_change(config, iteration, key, detail::value_text(detail::find_setting(key), changed));
  });
}

void apply_changes(Config& config, const toml::node& node, std::string_view source) {
  const toml::array* sections = node.as_array();
  const auto is_table = [](const toml::node& section) { return section.is_table(); };
  at_line(node, source, [&] {
    if (sections == nullptr || !std::all_of(sections->begin(), sections->end(), is_table))
      fail("change takes sections that begin with [[change]]");
  });
  for (const toml::node& section : *sections) apply_change(config, *section.as_table(), source);
}

toml::table parse(std::string_view toml, std::string_view source) {
  check_toml_keys(toml, source);
  try {
    return toml::parse(toml);
  } catch (const toml::parse_error& error) {
    fail(fmt::format("{}, line {}: this is not TOML ({}); settings are lines like `dt = 0.1`", source,
                     error.source().begin.line, error.description()));
  }
}

std::string toml_value(const Setting& setting, const Config& config) {
  Config copy = config;
  const Setting::Field field = setting.field(copy);
  if (auto* const* list = std::get_if<std::vector<double>*>(&field))
    return fmt::format("[{}]", fmt::join(**list, ", "));
  const std::string text = detail::value_text(setting, config);
  return std::holds_alternative<std::string*>(field) ? fmt::format("\"{}\"", text) : text;
}

std::string comment_of(const Setting& setting, const Config& config, const Config& fresh) {
  std::string text = setting.help;
  if (!setting.unit.empty()) text += fmt::format(" [{}]", setting.unit);
  if (setting.has_range()) {
    text += fmt::format("; {} to {}", setting.min, setting.max);
  } else if (!setting.words.empty()) {
    text += fmt::format("; {}", fmt::join(setting.words, ", "));
  }
  const std::string usual = toml_value(setting, fresh);
  return toml_value(setting, config) == usual ? text : text + "; default " + usual;
}

std::string changes_toml(const Config& config) {
  std::string text;
  std::int64_t iteration = -1;
  for (const Change& change : config.changes) {
    if (change.iteration != iteration)
      text += fmt::format("\n[[change]]\niteration = {}\n", change.iteration);
    iteration = change.iteration;
    Config changed = config;
    set(changed, change.key, change.value);
    text += fmt::format("\"{}\" = {}\n", change.key, toml_value(detail::find_setting(change.key), changed));
  }
  return text;
}

nlohmann::ordered_json json_value(const Setting& setting, const Config& config) {
  Config copy = config;
  return std::visit([](const auto* value) { return nlohmann::ordered_json(*value); }, setting.field(copy));
}

nlohmann::ordered_json changes_json(const Config& config) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Change& change : config.changes) {
    if (list.empty() || list.back().at("iteration") != change.iteration)
      list.push_back(nlohmann::ordered_json::object({{"iteration", change.iteration}}));
    Config changed = config;
    set(changed, change.key, change.value);
    list.back()[change.key] = json_value(detail::find_setting(change.key), changed);
  }
  return list;
}

// Whether the piece of a line between two commas is but a number, the end of a list or nothing.
bool is_number_of_a_list(std::string_view piece) {
  return piece.find_first_not_of("0123456789+-.eE_ \t\r]") == piece.npos &&
         std::count(piece.begin(), piece.end(), '.') <= 1;
}

// The dots of a line that may stand in keys. Those of the numbers in a list do not count: a dotted key goes
// on across commas only within quotes.
std::ptrdiff_t dots_of_keys(std::string_view line) {
  std::ptrdiff_t dots = 0;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    const std::string_view piece = line.substr(at, comma - at);
    if (!is_number_of_a_list(piece)) dots += std::count(piece.begin(), piece.end(), '.');
    at = comma + 1;
  }
  return dots;
}

}  // namespace

void check_toml_keys(std::string_view toml, std::string_view source) {
  constexpr std::ptrdiff_t kMostDots = 64;  // of a line with its comment; our keys have two at most
  for (int line = 1; !toml.empty(); ++line) {
    const std::string_view text = toml.substr(0, toml.find('\n'));
    toml.remove_prefix(std::min(text.size() + 1, toml.size()));
    const bool comment =
        text.substr(std::min(text.find_first_not_of(" \t"), text.size())).substr(0, 1) == "#";
    if (!comment && dots_of_keys(text) > kMostDots)
      fail(fmt::format("{}, line {}: it has more than {} dots, as no setting has", source, line, kMostDots));
  }
}

void apply_toml(Config& config, std::string_view toml, std::string_view source) {
  toml::table document = parse(toml, source);
  if (const toml::node* changes = document.get(kChange)) apply_changes(config, *changes, source);
  document.erase(kChange);
  for_each_value(document, "", source,
                 [&](const std::string& key, const toml::node& node) { apply_node(config, key, node); });
}

Config resolve_config(const std::string& preset, std::string_view toml, std::string_view source,
                      const std::vector<Assignment>& assignments) {
  std::string named = parse(toml, source)["species"].value_or(preset);
  for (const Assignment& assignment : assignments) {
    if (assignment.key == "species") named = assignment.value;
  }
  Config config = default_config(species("generic"));
  set(config, "species", named);  // refuses an unknown one as a setting
  config = default_config(species(named));
  apply_toml(config, toml, source);
  for (const Assignment& assignment : assignments) set(config, assignment.key, assignment.value);
  return config;
}

std::string to_toml(const Config& config, bool commented) {
  const Config fresh = default_config(species(config.species));
  std::string text, section;
  for (const Setting& setting : settings()) {
    const std::size_t dot = setting.key.find('.');
    const std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    if (table != section) {
      text += fmt::format("\n[{}]\n", table);
      section = table;
    }
    const std::string name = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
    const std::string line = fmt::format("{} = {}", name, toml_value(setting, config));
    text += commented ? fmt::format("{:<31} # {}\n", line, comment_of(setting, config, fresh)) : line + "\n";
  }
  return text + changes_toml(config);
}

std::string unusual_toml(const Config& config) {
  const Config usual = default_config(species(config.species));
  std::string text;
  for (const Setting& setting : settings()) {
    const std::string value = toml_value(setting, config);
    if (setting.key == "species" || value != toml_value(setting, usual))
      text += fmt::format("{} = {}\n", setting.key, value);
  }
  return text + changes_toml(config);
}

std::string to_json(const Config& config) {
  nlohmann::ordered_json json;
  for (const Setting& setting : settings()) json[setting.key] = json_value(setting, config);
  if (!config.changes.empty()) json[kChange] = changes_json(config);
  return json.dump();
}

}  // namespace wilt
