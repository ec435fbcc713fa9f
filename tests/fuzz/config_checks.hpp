// What holds for every configuration that was accepted.
#pragma once

#include <algorithm>
#include <string>

#include "fuzz/contract.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt::fuzz {

/// Every setting within the range of its row of the table; the same configuration again from its own TOML.
inline void check_config(Config config, bool commented) {
  for (const Setting& setting : settings()) {
    const Setting::Field field = setting.field(config);
    if (const auto* number = std::get_if<double*>(&field))
      require(**number >= setting.min && **number <= setting.max, "a number lies in its range");
    if (const auto* whole = std::get_if<std::int64_t*>(&field))
      require(double(**whole) >= setting.min && double(**whole) <= setting.max,
              "a whole number lies in its range");
    if (const auto* list = std::get_if<std::vector<double>*>(&field)) {
      for (const double number : **list)
        require(number >= setting.min && number <= setting.max, "each number of a list lies in its range");
      require((*list)->size() % static_cast<std::size_t>(setting.multiple) == 0, "a list has its multiple");
    }
    if (const auto* word = std::get_if<std::string*>(&field); word && !setting.words.empty())
      require(std::find(setting.words.begin(), setting.words.end(), **word) != setting.words.end(),
              "a word is one of those allowed");
  }
  for (const Change& change : config.changes)
    require(config_after(config, change.iteration).changes.size() == config.changes.size(),
            "what changes in a run may be set");
  Config again = default_config(species("willow"));
  apply_toml(again, to_toml(config, commented), "again.toml");
  require(to_json(again) == to_json(config), "to_toml() gives the same configuration back");
}

}  // namespace wilt::fuzz
