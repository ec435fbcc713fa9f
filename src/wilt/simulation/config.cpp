#include "wilt/simulation/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/simulation/setting_values.hpp"

namespace wilt {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kLongestList = 3000;  // every vertex asks every corner of water.dry_region

// The least that is allowed beside 0, where 0 has a meaning of its own.
int least_above_zero(const std::string& key) {
  return key == "vertices" ? 200 : key == "texture.size" ? 16 : 0;
}

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

bool is_list(const Setting& setting) {
  Config any;
  return std::holds_alternative<std::vector<double>*>(setting.field(any));
}

std::string allowed(const Setting& setting) {
  return fmt::format("{}{} must be between {} and {}{}", is_list(setting) ? "each number of " : "",
                     setting.key, setting.min, setting.max, setting.unit.empty() ? "" : " " + setting.unit);
}

// -0 is written as what TOML reads back as 0.
double without_sign_of_zero(double value) {
  return value == 0.0 ? 0.0 : value;
}

void check_range(const Setting& setting, double value) {
  if (!(value >= setting.min && value <= setting.max))
    fail(fmt::format("{}, not {}", allowed(setting), value));
}

double number_in(const Setting& setting, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') fail(fmt::format("{}, not '{}'", allowed(setting), text));
  return number;
}

std::vector<double> numbers_in(const Setting& setting, const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; !text.empty() && at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    numbers.push_back(number_in(setting, text.substr(at, comma - at)));
    at = comma + 1;
  }
  return numbers;
}

bool comes_before(const Change& a, const Change& b) {
  return std::pair(a.iteration, a.key) < std::pair(b.iteration, b.key);
}

}  // namespace

namespace detail {

const Setting& find_setting(std::string_view key) {
  Words keys;
  for (const Setting& setting : settings()) {
    if (setting.key == key) return setting;
    keys.push_back(setting.key);
  }
  fail(fmt::format("unknown setting '{}'{}; `wilt simulate --print-config` lists them all", key,
                   did_you_mean(key, keys)));
}

bool is_number(const Setting::Field& field) {
  return std::holds_alternative<double*>(field) || std::holds_alternative<std::int64_t*>(field);
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
    **number = without_sign_of_zero(value);
  } else if (value != std::floor(value)) {
    fail(fmt::format("{} must be a whole number, not {}", setting.key, value));
  } else if (const int least = least_above_zero(setting.key); value > 0 && value < least) {
    fail(fmt::format("{} must be 0 or between {} and {}, not {}", setting.key, least, setting.max, value));
  } else {
    *std::get<std::int64_t*>(field) = static_cast<std::int64_t>(value);
  }
}

void assign_list(const Setting& setting, std::vector<double>& field, std::vector<double> values) {
  const std::size_t count = values.size(), multiple = static_cast<std::size_t>(setting.multiple);
  const auto refuse = [&](const std::string& wanted) {
    fail(fmt::format("{} takes {}, not {}", setting.key, wanted, count));
  };
  if (count % multiple != 0) refuse(fmt::format("a multiple of {} numbers", multiple));
  if (count > 0 && count < static_cast<std::size_t>(setting.fewest))
    refuse(fmt::format("{} numbers or more, or none", setting.fewest));
  if (count > kLongestList) refuse(fmt::format("{} numbers at most", kLongestList));
  for (double& value : values) {
    check_range(setting, value);
    value = without_sign_of_zero(value);
  }
  field = std::move(values);
}

std::string value_text(const Setting& setting, const Config& config) {
  Config copy = config;
  const Setting::Field field = setting.field(copy);
  if (auto* const* number = std::get_if<double*>(&field)) return fmt::format("{}", **number);
  if (auto* const* integer = std::get_if<std::int64_t*>(&field)) return fmt::format("{}", **integer);
  if (auto* const* flag = std::get_if<bool*>(&field)) return **flag ? "true" : "false";
  if (auto* const* list = std::get_if<std::vector<double>*>(&field))
    return fmt::format("{}", fmt::join(**list, ","));
  return *std::get<std::string*>(field);
}

}  // namespace detail

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
  const Setting& setting = detail::find_setting(key);
  const Setting::Field field = setting.field(config);
  const std::string text(value);
  if (std::string* const* word = std::get_if<std::string*>(&field)) {
    detail::assign_word(setting, **word, text);
  } else if (auto* const* list = std::get_if<std::vector<double>*>(&field)) {
    detail::assign_list(setting, **list, numbers_in(setting, text));
  } else if (bool* const* flag = std::get_if<bool*>(&field)) {
    if (text != "true" && text != "false") fail(fmt::format("{} must be true or false, not '{}'", key, text));
    **flag = text == "true";
  } else {
    detail::assign_number(setting, field, number_in(setting, text));
  }
}

void add_change(Config& config, std::int64_t iteration, std::string_view key, std::string_view value) {
  constexpr std::int64_t kLastIteration = 1000000;
  const Setting& setting = detail::find_setting(key);
  if (!setting.during_run)
    fail(
        fmt::format("{} cannot change in a run; give it for the whole run (`wilt simulate --print-config "
                    "--json` marks those that can: during_run)",
                    key));
  if (iteration < 0 || iteration > kLastIteration)
    fail(fmt::format("a change comes after iteration 0 to {}, not {}", kLastIteration, iteration));
  Config changed = config;
  set(changed, key, value);
  const Change change{iteration, setting.key, detail::value_text(setting, changed)};
  auto& changes = config.changes;
  const auto place = std::lower_bound(changes.begin(), changes.end(), change, comes_before);
  if (place != changes.end() && !comes_before(change, *place))
    *place = change;
  else
    changes.insert(place, change);
}

Config config_after(const Config& config, std::int64_t iteration) {
  Config after = config;
  for (const Change& change : config.changes) {
    if (change.iteration <= iteration) set(after, change.key, change.value);
  }
  return after;
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
