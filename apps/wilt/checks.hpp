// What options take: checked before CLI11 converts it, refused in our own words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace wilt::cli {

/// For Option::check: a whole number, `least` to `most`.
CLI::Validator whole_number(std::int64_t least, std::int64_t most);

/// The largest seed: a double holds it, and so does every language that reads JSON.
inline constexpr std::int64_t kMostSeed = 9'000'000'000'000'000;

/// A finite number, `least` to `most`.
CLI::Validator number(double least, double most);

/// One of these words.
CLI::Validator one_of(const std::vector<std::string>& words);

/// Refuses nothing: words that a shell may offer. One that ends in '=' is to be continued.
CLI::Validator offers(const std::vector<std::string>& words);

/// What the option takes, as its type name says: "FILE"; behind it CLI11 would show the checks.
std::string value_name(const CLI::Option& option);

/// The words of the option's one_of() or offers().
std::vector<std::string> words_of(CLI::Option& option);

}  // namespace wilt::cli
