#include "wilt/studio/settings_json.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "wilt/leaf/species.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_of(const double*) {
  return "number";
}
const char* kind_of(const std::int64_t*) {
  return "whole";
}
const char* kind_of(const bool*) {
  return "flag";
}
const char* kind_of(const std::string*) {
  return "word";
}
const char* kind_of(const std::vector<double>*) {
  return "numbers";
}

Json value_of(const Setting& setting, Config& config) {
  return std::visit([](const auto* value) { return Json(*value); }, setting.field(config));
}

}  // namespace

std::string settings_json(const Config& config) {
  Config now = config, usual = default_config(species(config.species));
  Json list = Json::array();
  for (const Setting& setting : settings()) {
    const char* kind = std::visit([](const auto* field) { return kind_of(field); }, setting.field(now));
    list.push_back({{"key", setting.key},
                    {"unit", setting.unit},
                    {"help", setting.help},
                    {"kind", kind},
                    {"min", setting.min},
                    {"max", setting.max},
                    {"words", setting.key == "species" ? species_names() : setting.words},
                    {"value", value_of(setting, now)},
                    {"usual", value_of(setting, usual)},
                    {"duringRun", setting.during_run}});
  }
  return list.dump();
}

}  // namespace wilt
