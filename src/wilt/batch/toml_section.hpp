// Sections of a TOML document whose keys are known; for inside the batch room only.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "wilt/core/types.hpp"

namespace wilt::detail {

/// What to do with the value of a key; what it throws gets source and line.
using Take = std::function<void(const std::string& key, const toml::node& value)>;

/// The document. Throws Error{configuration} with source and line for what is no TOML.
toml::table parse_toml(std::string_view text, const std::string& source);

/// Calls take(key, node) for each key of a table. Error{configuration} that it throws, but not one of a key
/// within, is thrown again with source and line.
void for_each_key(const toml::table& table, const std::string& source, const Take& take);

/// Hands each key of a section ("" is the whole document) to its taker. Throws Error{configuration} with
/// source and line for a key that is not known, with the nearest one.
void take_section(const toml::node& node, const std::string& section, const std::string& source,
                  const std::map<std::string, Take>& takers);

// Values of one kind. They throw Error{configuration} that says what `key` takes.
std::int64_t whole_number(const std::string& key, const toml::node& node, std::int64_t least,
                          std::int64_t most);
double number(const std::string& key, const toml::node& node, double least, double most);
bool flag(const std::string& key, const toml::node& node);
std::string word(const std::string& key, const toml::node& node);
const toml::array& pair(const std::string& key, const toml::node& node);  ///< of what `key` says
/// One word or a list of them; `allowed` empty: any.
std::vector<std::string> words(const std::string& key, const toml::node& node,
                               const std::vector<std::string>& allowed);

}  // namespace wilt::detail
