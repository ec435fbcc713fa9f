#include "settings_list.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> words_for(const Setting& setting, const Json& value) {
  if (value.is_boolean()) return {"true", "false"};
  return setting.key == "species" ? species_names() : setting.words;
}

}  // namespace

std::vector<SettingText> list_settings(const Config& config) {
  const Json values = Json::parse(to_json(config));
  std::vector<SettingText> list;
  for (const Setting& setting : settings()) {
    const Json& value = values.at(setting.key);
    list.push_back({setting.key, value.is_string() ? value.get<std::string>() : value.dump(), setting.unit,
                    setting.help,
                    setting.has_range() ? fmt::format("{} to {}", setting.min, setting.max)
                                        : fmt::format("{}", fmt::join(words_for(setting, value), ", "))});
  }
  return list;
}

std::string settings_json(const Config& config) {
  const Json values = Json::parse(to_json(config)),
             fresh = Json::parse(to_json(default_config(species(config.species))));
  Json list = Json::array();
  for (const Setting& setting : settings()) {
    const Json& value = values.at(setting.key);
    Json row = {
        {"key", setting.key}, {"value", value}, {"default", fresh.at(setting.key)}, {"unit", setting.unit}};
    if (setting.has_range())
      row["range"] = {setting.min, setting.max};
    else
      row["words"] = words_for(setting, value);
    row["during_run"] = setting.during_run;
    row["help"] = setting.help;
    list.push_back(std::move(row));
  }
  return list.dump(2) + "\n";
}

}  // namespace wilt::cli
