#include "wilt/simulation/config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"

namespace wilt {
namespace {

using Words = std::vector<std::string>;

// The least that is allowed beside 0, where 0 has a meaning of its own.
int least_above_zero(const std::string& key) {
  return key == "vertices" ? 200 : key == "texture.size" ? 16 : 0;
}

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

const Setting& find_setting(std::string_view key) {
  Words keys;
  for (const Setting& setting : settings()) {
    if (setting.key == key) return setting;
    keys.push_back(setting.key);
  }
  fail(fmt::format("unknown setting '{}'{}; `wilt simulate --print-config` lists them all", key,
                   did_you_mean(key, keys)));
}

std::string allowed(const Setting& setting) {
  return fmt::format("{} must be between {} and {}{}", setting.key, setting.min, setting.max,
                     setting.unit.empty() ? "" : " " + setting.unit);
}

void check_range(const Setting& setting, double value) {
  if (!(value >= setting.min && value <= setting.max))
    fail(fmt::format("{}, not {}", allowed(setting), value));
}

void assign_word(const Setting& setting, std::string& field, const std::string& value) {
  if (setting.key == "species") {
    try {
      field = species(value).name;
    } catch (const Error& error) {
      fail(fmt::format("species: {}", error.what()));
    }
    return;
  }
  if (std::find(setting.words.begin(), setting.words.end(), value) == setting.words.end())
    fail(fmt::format("{} must be one of {}, not '{}'{}", setting.key, fmt::join(setting.words, ", "), value,
                     did_you_mean(value, setting.words)));
  field = value;
}

void assign_number(const Setting& setting, const Setting::Field& field, double value) {
  check_range(setting, value);
  if (auto* const* number = std::get_if<double*>(&field)) {
    **number = value;
  } else if (value != std::floor(value)) {
    fail(fmt::format("{} must be a whole number, not {}", setting.key, value));
  } else if (const int least = least_above_zero(setting.key); value > 0 && value < least) {
    fail(fmt::format("{} must be 0 or between {} and {}, not {}", setting.key, least, setting.max, value));
  } else {
    *std::get<std::int64_t*>(field) = static_cast<std::int64_t>(value);
  }
}

bool is_number(const Setting::Field& field) {
  return std::holds_alternative<double*>(field) || std::holds_alternative<std::int64_t*>(field);
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix,
                 std::string_view source);

void apply_node(Config& config, const std::string& key, const toml::node& node, std::string_view source) {
  if (const toml::table* nested = node.as_table()) return apply_table(config, *nested, key + ".", source);
  try {
    const Setting& setting = find_setting(key);
    const Setting::Field field = setting.field(config);
    if (is_number(field) && node.is_number()) {
      assign_number(setting, field, *node.value<double>());
    } else if (bool* const* flag = std::get_if<bool*>(&field); flag && node.is_boolean()) {
      **flag = *node.value<bool>();
    } else if (std::string* const* word = std::get_if<std::string*>(&field); word && node.is_string()) {
      assign_word(setting, **word, *node.value<std::string>());
    } else {
      fail(fmt::format("{} must be {}", key,
                       is_number(field)                       ? "a number"
                       : std::holds_alternative<bool*>(field) ? "true or false"
                                                              : "a word in quotes"));
    }
  } catch (const Error& error) {
    fail(fmt::format("{}, line {}: {}", source, node.source().begin.line, error.what()));
  }
}

void apply_table(Config& config, const toml::table& table, const std::string& prefix,
                 std::string_view source) {
  for (const auto& [key, node] : table) apply_node(config, prefix + std::string(key.str()), node, source);
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

// The shortest decimal form that reads back to the same number.
std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string value_text(const Setting& setting, Config& config) {
  const Setting::Field field = setting.field(config);
  if (auto* const* number = std::get_if<double*>(&field)) return number_text(**number);
  if (auto* const* integer = std::get_if<std::int64_t*>(&field)) return fmt::format("{}", **integer);
  if (auto* const* flag = std::get_if<bool*>(&field)) return **flag ? "true" : "false";
  return fmt::format("\"{}\"", *std::get<std::string*>(field));
}

std::string comment_of(const Setting& setting, Config& config, Config& fresh) {
  std::string text = setting.help;
  if (!setting.unit.empty()) text += fmt::format(" [{}]", setting.unit);
  if (is_number(setting.field(config))) {
    text += fmt::format("; {} to {}", setting.min, setting.max);
  } else if (!setting.words.empty()) {
    text += fmt::format("; {}", fmt::join(setting.words, ", "));
  }
  const std::string usual = value_text(setting, fresh);
  return value_text(setting, config) == usual ? text : text + "; default " + usual;
}

}  // namespace

Config default_config(const Species& species) {
  Config config;
  const Physiology& p = species.physiology;
  config.species = species.name;
  config.mass.min = p.mass_min;
  config.mass.max = p.mass_max;
  config.water.loss_rate = p.dehydration_rate;
  config.water.dryness_scale = p.dryness_scale;
  config.external.range = p.force_range;
  config.shrinkage.amount = p.shrinkage;
  config.curvature.roll = p.roll;
  return config;
}

void set(Config& config, std::string_view key, std::string_view value) {
  const Setting& setting = find_setting(key);
  const Setting::Field field = setting.field(config);
  const std::string text(value);
  if (std::string* const* word = std::get_if<std::string*>(&field)) return assign_word(setting, **word, text);
  if (bool* const* flag = std::get_if<bool*>(&field)) {
    if (text != "true" && text != "false") fail(fmt::format("{} must be true or false, not '{}'", key, text));
    **flag = text == "true";
    return;
  }
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') fail(fmt::format("{}, not '{}'", allowed(setting), text));
  assign_number(setting, field, number);
}

void check_toml_keys(std::string_view toml, std::string_view source) {
  constexpr std::ptrdiff_t kMostDots = 64;  // of a line with its comment; our keys have two at most
  for (int line = 1; !toml.empty(); ++line) {
    const std::string_view text = toml.substr(0, toml.find('\n'));
    toml.remove_prefix(std::min(text.size() + 1, toml.size()));
    const bool comment =
        text.substr(std::min(text.find_first_not_of(" \t"), text.size())).substr(0, 1) == "#";
    if (!comment && std::count(text.begin(), text.end(), '.') > kMostDots)
      fail(fmt::format("{}, line {}: it has more than {} dots, as no setting has", source, line, kMostDots));
  }
}

void apply_toml(Config& config, std::string_view toml, std::string_view source) {
  apply_table(config, parse(toml, source), "", source);
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
  Config copy = config, fresh = default_config(species(config.species));
  std::string text, section;
  for (const Setting& setting : settings()) {
    const std::size_t dot = setting.key.find('.');
    const std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    if (table != section) {
      text += fmt::format("\n[{}]\n", table);
      section = table;
    }
    const std::string name = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
    const std::string line = fmt::format("{} = {}", name, value_text(setting, copy));
    text += commented ? fmt::format("{:<32}# {}\n", line, comment_of(setting, copy, fresh)) : line + "\n";
  }
  return text;
}

std::string to_json(const Config& config) {
  Config copy = config;
  nlohmann::ordered_json json;
  for (const Setting& setting : settings())
    std::visit([&](const auto* value) { json[setting.key] = *value; }, setting.field(copy));
  return json.dump();
}

VenationOptions venation_options(const Config& config) {
  VenationOptions options;
  options.peaks.rule = config.veins.peaks == "window" ? PeakRule::window : PeakRule::prominence;
  options.peaks.window_vertices = static_cast<int>(config.veins.window_vertices);
  options.peaks.window_length = config.veins.window_length;
  options.peaks.min_prominence = config.veins.min_prominence;
  options.geodesics = config.veins.geodesics == "exact" ? GeodesicMethod::exact : GeodesicMethod::fast;
  options.full_embedding_up_to = static_cast<int>(config.veins.full_embedding_up_to);
  options.landmarks = static_cast<int>(config.veins.landmarks);
  options.secondary = config.veins.secondary;
  options.from_photo = config.veins.from_photo;
  return options;
}

}  // namespace wilt
