// One setting's value: checked, assigned, written. Inside the simulation room only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wilt/simulation/config.hpp"

namespace wilt::detail {

/// Throws Error{configuration} with the nearest key.
const Setting& find_setting(std::string_view key);

bool is_number(const Setting::Field& field);

/// These throw Error{configuration} for what the setting does not take, which is then as it was.
void assign_word(const Setting& setting, std::string& field, const std::string& value);
void assign_number(const Setting& setting, const Setting::Field& field, double value);
void assign_list(const Setting& setting, std::vector<double>& field, std::vector<double> values);

/// A value as `set` takes it. Numbers have the shortest decimal form that reads back to the same number.
std::string value_text(const Setting& setting, const Config& config);

}  // namespace wilt::detail
