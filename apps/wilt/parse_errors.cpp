#include "parse_errors.hpp"

#include <fmt/format.h>

#include "checks.hpp"
#include "wilt/core/nearest.hpp"

namespace wilt::cli {
namespace {

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    for (const std::string& name : option->get_snames()) flags.push_back("-" + name);
  }
  return flags;
}

// "--vertices: takes ..." as a sentence.
std::string as_sentence(std::string text) {
  const std::size_t colon = text.find(": ");
  if (colon != std::string::npos) text.erase(colon, 1);
  return text;
}

// An error about a number of arguments begins or ends with the option.
std::string about_arguments(const CLI::App& app, const std::string& text) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (text.rfind(name + ": At Most", 0) == 0) return name + " was given more than once; give it once";
    if (text.rfind(name + ": ", 0) == 0 || text.rfind(name + " ", 0) == 0) {
      if (option->get_items_expected_max() == 0) return name + " takes no value; leave out what follows it";
      return fmt::format("{} needs a value, {}", name, value_name(*option));
    }
  }
  return as_sentence(text);
}

// A word that is no option and has no place.
std::string about_extra(const std::string& word, const CLI::App& verb, bool is_main) {
  if (is_main) return fmt::format("'{}' is more than is needed", word);
  return fmt::format("'{}' is one word too many for `wilt {}`; put quotes around a name with spaces", word,
                     verb.get_name());
}

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error,
                    const std::vector<std::string>& words) {
  const CLI::App* verb = &app;
  for (const CLI::App* sub : app.get_subcommands()) verb = sub;
  const bool is_main = verb == &app;
  const std::string see = fmt::format("; see `wilt {}--help`", is_main ? "" : verb->get_name() + " ");
  if (error.get_name() == "ExtrasError") {
    const std::vector<std::string> verbs = verbs_of(app);
    if (is_main && !words.empty() && words.front().rfind('-', 0) != 0)
      return fmt::format("unknown command '{}'{}; the commands are {}", words.front(),
                         did_you_mean(words.front(), verbs), fmt::join(verbs, ", "));
    std::vector<std::string> flags = flags_of(app);
    for (const std::string& flag : flags_of(*verb)) flags.push_back(flag);
    for (const std::string& word : verb->remaining()) {
      const std::string flag = word.substr(0, word.find('='));
      if (flag.size() > 1 && flag[0] == '-')
        return fmt::format("unknown option '{}'{}{}", flag, did_you_mean(flag, flags), see);
    }
    if (!verb->remaining().empty()) return about_extra(verb->remaining().front(), *verb, is_main) + see;
  }
  const std::string text = error.what();
  if (error.get_name() == "RequiredError")
    return fmt::format("{} is missing{}", text.substr(0, text.find(' ')), see);
  if (error.get_name() == "ArgumentMismatch" || error.get_name() == "ConversionError") {
    const std::string said = about_arguments(*verb, text);
    return (said == as_sentence(text) ? about_arguments(app, text) : said) + see;
  }
  return as_sentence(text) + see;
}

}  // namespace wilt::cli
