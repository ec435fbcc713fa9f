#include "command_line.hpp"

#include <CLI/CLI.hpp>

#include "checks.hpp"

namespace wilt::cli {
namespace {

OptionText text_of(CLI::Option& option) {
  OptionText text;
  text.positional = option.get_positional();
  if (text.positional) text.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  const bool is_flag = option.get_items_expected_max() == 0;
  if (!is_flag) text.value = value_name(option);
  text.description = option.get_description();
  text.words = words_of(option);
  text.required = option.get_required();
  text.repeatable = !is_flag && option.get_expected_max() > 1;
  return text;
}

std::vector<OptionText> options_of(CLI::App& app) {
  std::vector<OptionText> options;
  for (CLI::Option* option : app.get_options()) options.push_back(text_of(*option));
  return options;
}

// A description is a summary, and behind "Examples:" a line for each.
std::vector<std::string> take_examples(std::string& description) {
  static const std::string kHeading = "\n\nExamples:\n";
  const std::size_t heading = description.find(kHeading);
  if (heading == std::string::npos) return {};
  std::vector<std::string> lines = CLI::detail::split(description.substr(heading + kHeading.size()), '\n');
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  for (std::string& line : lines) CLI::detail::ltrim(line);
  description.resize(heading);
  return lines;
}

}  // namespace

CommandLine describe(CLI::App& app) {
  CommandLine line;
  line.introduction = app.get_description();
  line.examples = take_examples(line.introduction);
  line.options = options_of(app);
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    VerbText text;
    text.name = verb->get_name();
    text.summary = verb->get_description();
    text.examples = take_examples(text.summary);
    text.options = options_of(*verb);
    line.verbs.push_back(std::move(text));
  }
  return line;
}

}  // namespace wilt::cli
