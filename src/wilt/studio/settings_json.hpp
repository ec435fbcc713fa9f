// The settings as a page shows them.
#pragma once

#include <string>

#include "wilt/simulation/config.hpp"

namespace wilt {

/// [{"key", "unit", "help", "kind", "min", "max", "words", "value", "usual", "duringRun"}, ...] in the order
/// of settings(); kind: number, whole, flag, word, numbers; usual: the default of the configuration's
/// species.
std::string settings_json(const Config& config);

}  // namespace wilt
