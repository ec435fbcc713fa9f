#include "settings_list.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

using Json = nlohmann::ordered_json;

Json value_of(const Setting& setting, Config& config) {
  return std::visit([](const auto* value) { return Json(*value); }, setting.field(config));
}

std::vector<std::string> words_for(const Setting& setting, const Json& value) {
  if (value.is_boolean()) return {"true", "false"};
  return setting.key == "species" ? species_names() : setting.words;
}

}  // namespace

std::vector<SettingText> list_settings(const Config& config) {
  Config copy = config;
  std::vector<SettingText> list;
  for (const Setting& setting : settings()) {
    const Json value = value_of(setting, copy);
    SettingText text{setting.key,  value.is_string() ? value.get<std::string>() : value.dump(),
                     setting.unit, setting.help,
                     "",           words_for(setting, value)};
    text.allowed = value.is_number() ? fmt::format("{} to {}", setting.min, setting.max)
                                     : fmt::format("{}", fmt::join(text.words, ", "));
    list.push_back(std::move(text));
  }
  return list;
}

std::string settings_json(const Config& config) {
  Config copy = config, fresh = default_config(species(config.species));
  Json list = Json::array();
  for (const Setting& setting : settings()) {
    const Json value = value_of(setting, copy);
    Json row = {{"key", setting.key},
                {"value", value},
                {"default", value_of(setting, fresh)},
                {"unit", setting.unit}};
    if (value.is_number())
      row["range"] = {setting.min, setting.max};
    else
      row["words"] = words_for(setting, value);
    row["help"] = setting.help;
    list.push_back(std::move(row));
  }
  return list.dump(2) + "\n";
}

}  // namespace wilt::cli
