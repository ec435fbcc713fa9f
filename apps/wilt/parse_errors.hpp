// What CLI11 finds wrong with a command line, in our own words.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace wilt::cli {

/// The message for an error that parsing `words` has thrown: the word that does not fit, the nearest that
/// does, and where to look.
std::string explain(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace wilt::cli
