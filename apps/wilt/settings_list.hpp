// The table of settings as the manual and `--print-config --json` show it.
#pragma once

#include <string>
#include <vector>

#include "wilt/simulation/config.hpp"

namespace wilt::cli {

struct SettingText {
  std::string key, value, unit, help;
  std::string allowed;  ///< "0 to 1", "ring, free", "true, false"
};

/// Every setting with its value in `config`.
std::vector<SettingText> list_settings(const Config& config);

/// The same as JSON: a list of {"key", "value", "default", "unit", "range": [least, most] or "words",
/// "help"}; defaults are those of the configuration's species.
std::string settings_json(const Config& config);

}  // namespace wilt::cli
