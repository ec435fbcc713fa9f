#include "parse_errors.hpp"

#include <fmt/format.h>

#include <optional>

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

// An error about the arguments of an option.
std::optional<std::string> about_arguments(const CLI::App& app, std::string text) {
  const std::string conversion = "Could not convert: ";  // of flags; the others' values are checked before
  if (text.rfind(conversion, 0) == 0) text.erase(0, conversion.size());
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (text.rfind(name + ": At Most", 0) == 0) return name + " was given more than once; give it once";
    if (text.rfind(name + ": ", 0) == 0 || text.rfind(name + " ", 0) == 0) {
      if (option->get_items_expected_max() == 0) return name + " takes no value; leave out what follows it";
      return fmt::format("{} needs a value, {}", name, value_name(*option));
    }
  }
  return std::nullopt;
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
  const auto is = [&error](CLI::ExitCodes kind) { return error.get_exit_code() == static_cast<int>(kind); };
  if (is(CLI::ExitCodes::ExtrasError)) {
    const std::vector<std::string> verbs = verbs_of(app);
    if (is_main && !words.empty() && words.front().rfind('-', 0) != 0)
      return fmt::format("unknown command '{}'{}; the commands are {}", words.front(),
                         did_you_mean(words.front(), verbs), fmt::join(verbs, ", "));
    std::vector<std::string> flags = flags_of(app);
    for (const std::string& flag : flags_of(*verb)) flags.push_back(flag);
    const std::vector<std::string> extra = app.remaining(true);
    for (const std::string& word : extra) {
      const std::string flag = word.substr(0, word.find('='));
      if (flag.size() > 1 && flag[0] == '-')
        return fmt::format("unknown option '{}'{}{}", flag, did_you_mean(flag, flags), see);
    }
    if (!extra.empty()) return about_extra(extra.front(), *verb, is_main) + see;
  }
  const std::string text = error.what();
  if (is(CLI::ExitCodes::RequiredError))
    return fmt::format("{} is missing{}", text.substr(0, text.find(' ')), see);
  if (is(CLI::ExitCodes::ArgumentMismatch) || is(CLI::ExitCodes::ConversionError)) {
    for (const CLI::App* owner : {verb, &app}) {
      if (const auto said = about_arguments(*owner, text)) return *said + see;
    }
  }
  return as_sentence(text) + see;
}

}  // namespace wilt::cli
