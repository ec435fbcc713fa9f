#include "completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace wilt::cli {
namespace {

using Options = std::vector<OptionText>;

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

// In single quotes; the quotes inside by `quote`.
std::string quoted(const std::string& text, const char* quote = "'\\''") {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string(quote) : std::string(1, c);
  return result + "'";
}

// A description's first line, which is enough beside an option.
std::string brief(const std::string& description) {
  return description.substr(0, description.find('\n'));
}

std::vector<std::string> verb_names(const CommandLine& line) {
  std::vector<std::string> names;
  for (const VerbText& verb : line.verbs) names.push_back(verb.name);
  return names;
}

bool are_begun(const std::vector<std::string>& words) {
  return !words.empty() && words.front().back() == '=';
}

// ---- bash: a function that looks at the word before, then at the verb

std::string bash_offer(const OptionText& option) {
  std::string text;
  if (!option.words.empty()) text += fmt::format("_wilt_words {}; ", quoted(joined(option.words)));
  if (are_begun(option.words)) text += "compopt -o nospace; ";
  if (option.takes_files()) text += "_wilt_files -f; ";
  if (option.takes_folders()) text += "_wilt_files -d; ";
  return text;
}

// Cases of the word before; a `where` of "*" is any verb.
std::string bash_values(const Options& options, const std::string& where) {
  std::string text;
  for (const OptionText& option : options) {
    if (option.positional || option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(where + ":" + name);
    text += fmt::format("    {}) {}return ;;\n", joined(patterns, "|"), bash_offer(option));
  }
  return text;
}

std::string bash_names(const Options& options) {
  std::vector<std::string> names;
  for (const OptionText& option : options)
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return joined(names);
}

std::string bash_verb(const VerbText& verb) {
  std::string positional;
  for (const OptionText& option : verb.options)
    if (option.positional) positional += bash_offer(option);
  return fmt::format("    {}) case $cur in -*) _wilt_words {} ;; *) {};; esac ;;\n", verb.name,
                     quoted(bash_names(verb.options)), positional.empty() ? ": " : positional);
}

std::string bash(const CommandLine& line) {
  const std::string verbs = joined(verb_names(line), "|");
  std::string text = fmt::format(R"(# wilt in bash, made by `wilt --completion bash`
_wilt_words() {{
  COMPREPLY+=($(compgen -W "$1" -- "$cur"))
}}
_wilt_files() {{
  local file
  compopt -o filenames
  while IFS= read -r file; do COMPREPLY+=("$file"); done < <(compgen "$1" -- "$cur")
}}
_wilt() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb= word
  COMPREPLY=()
  if [[ $cur == "=" ]]; then cur=
  elif [[ $before == "=" ]]; then before=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in {}) verb=$word; break ;; esac
  done
  case $verb:$before in
)",
                                 verbs);
  for (const VerbText& verb : line.verbs) text += bash_values(verb.options, verb.name);
  text += bash_values(line.options, "*");
  text += "  esac\n  case $verb in\n";
  for (const VerbText& verb : line.verbs) text += bash_verb(verb);
  return text + fmt::format(
                    "    *) [[ $cur == -* ]] || _wilt_words {} ;;\n  esac\n  [[ $cur != -* ]] || "
                    "_wilt_words {}\n}}\ncomplete -F _wilt wilt\n",
                    quoted(joined(verb_names(line))), quoted(bash_names(line.options)));
}

// ---- zsh: specifications for _arguments

std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

// The action behind "message:".
std::string zsh_action(const OptionText& option) {
  const std::string words = joined(option.words);
  const char* files = option.takes_folders() ? "_files -/" : option.takes_files() ? "_files" : "";
  if (words.empty()) return files;
  if (are_begun(option.words)) return fmt::format("{{compadd -S \"\" -- {}}}", words);
  if (*files == '\0') return fmt::format("({})", words);
  return fmt::format("{{_alternative \"words:word:({})\" \"files:file:{}\"}}", words, files);
}

std::string zsh_specs(const Options& options) {
  std::string text;
  int place = 0;
  for (const OptionText& option : options) {
    const std::string value =
        option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
    if (option.positional) {
      const std::string number = option.repeatable ? "*" : fmt::format("{}", ++place);
      text += fmt::format(" \\\n        {}", quoted(number + value));
      continue;
    }
    for (const std::string& name : option.names) {
      const std::string others = option.repeatable ? "*" : fmt::format("({})", joined(option.names));
      text += fmt::format(" \\\n        {}",
                          quoted(others + name + (option.value.empty() || name[1] != '-' ? "" : "=") + "[" +
                                 zsh_text(brief(option.description)) + "]" + value));
    }
  }
  return text;
}

std::string zsh(const CommandLine& line) {
  std::string text =
      "#compdef wilt\n# made by `wilt --completion zsh`\n_wilt() {\n  local curcontext=\"$curcontext\" state "
      "line\n  typeset -A opt_args\n  local -a commands\n  commands=(\n";
  for (const VerbText& verb : line.verbs)
    text += fmt::format("    {}\n", quoted(verb.name + ":" + zsh_text(brief(verb.summary))));
  const std::string common = zsh_specs(line.options);
  text += fmt::format(
      "  )\n  _arguments -C{} \\\n        ': :->command' '*:: :->rest'\n  case $state in\n    command) "
      "_describe command commands ;;\n    rest) case $words[1] in\n",
      common);
  for (const VerbText& verb : line.verbs)
    text += fmt::format("      {}) _arguments{}{} ;;\n", verb.name, zsh_specs(verb.options), common);
  return text + "    esac ;;\n  esac\n}\n_wilt \"$@\"\n";
}

// ---- fish: a line for each thing to offer

std::string fish_value(const OptionText& option) {
  if (option.value.empty()) return "";
  std::string text = option.takes_files() ? " -r -F" : " -x";
  if (option.takes_folders()) return text + " -a '(__fish_complete_directories)'";
  if (!option.words.empty()) text += " -a " + quoted(joined(option.words), "\\'");
  return text;
}

std::string fish_options(const Options& options, const std::string& when) {
  std::string text;
  for (const OptionText& option : options) {
    text += "complete -c wilt" + when;
    for (const std::string& name : option.names) {
      if (!option.positional) text += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (option.positional) {
      text += option.takes_files() ? " -F" : "";
      if (!option.words.empty()) text += " -a " + quoted(joined(option.words), "\\'");
    } else {
      text += fish_value(option);
    }
    text += " -d " + quoted(brief(option.description), "\\'") + "\n";
  }
  return text;
}

std::string fish(const CommandLine& line) {
  std::string text = "# wilt in fish, made by `wilt --completion fish`\ncomplete -c wilt -f\n";
  text += fish_options(line.options, "");
  for (const VerbText& verb : line.verbs)
    text += fmt::format("complete -c wilt -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                        quoted(brief(verb.summary), "\\'"));
  for (const VerbText& verb : line.verbs)
    text += fish_options(verb.options, fmt::format(" -n '__fish_seen_subcommand_from {}'", verb.name));
  return text;
}

const std::map<std::string, std::string (*)(const CommandLine&)>& shells() {
  static const std::map<std::string, std::string (*)(const CommandLine&)> kShells = {
      {"bash", bash}, {"fish", fish}, {"zsh", zsh}};
  return kShells;
}

}  // namespace

const std::vector<std::string>& completed_shells() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const auto& [name, make] : shells()) names.push_back(name);
    return names;
  }();
  return kNames;
}

std::string completion(const CommandLine& line, const std::string& shell) {
  return shells().at(shell)(line);
}

}  // namespace wilt::cli
