#include "manual.hpp"

#include <fmt/format.h>

#include <sstream>

#include "settings_list.hpp"
#include "wilt/core/version.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

// What no definition of an option says.
constexpr const char* kExitStatus = R"(.SH EXIT STATUS
.TP
.B 0
everything was done
.TP
.B 2
a wrong command line or configuration: an unknown key, a value out of range
.TP
.B 3
a LEAF or an input file that cannot be used
.TP
.B 4
the simulation could not go on; what was computed is kept
.TP
.B 5
something could not be written; what could be was
.TP
.B 130
interrupted (Ctrl-C, SIGTERM, SIGHUP); what was computed is kept. A second interrupt ends the program at once
.SH FILES
Every file is written whole or not at all: without a name or under a temporary one (\fI.wilt\-*.tmp\fR) in its folder, then
renamed, so that an old file stays until the new one is complete. A pipe or a device is written in place. Films are
encoded by \fBffmpeg\fR(1) in memory.
.P
Nothing else is read than what the command line names and what those files name beside them, and nothing from a network.
.SH ENVIRONMENT
.TP
.B NO_COLOR
no colours in messages, unless
.B \-\-color
asks for them
.TP
.B PATH
where \fBffmpeg\fR and \fBgnuplot\fR are found
)";

// As text: nothing in it is a request or an escape, and a hyphen can be copied.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  if (!result.empty() && (result[0] == '.' || result[0] == '\'')) result.insert(0, "\\&");
  return result;
}

// Lines that are indented stand for themselves, others are one paragraph.
std::string paragraph(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    if (begin > 0) result += ".br\n";
    result += escaped(line.substr(begin)) + "\n";
  }
  return result;
}

std::string examples(const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = ".P\n.EX\n";
  for (const std::string& line : lines) text += escaped(line) + "\n";
  return text + ".EE\n";
}

std::string option(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped(name));
  if (!option.positional && !option.value.empty()) names += fmt::format(" \\fI{}\\fR", escaped(option.value));
  return fmt::format(".TP\n{}\n{}", names, paragraph(option.description));
}

std::string options(const std::vector<OptionText>& all) {
  std::string text;
  for (const OptionText& one : all) text += option(one);
  return text;
}

std::string synopsis(const VerbText& verb) {
  std::string text = fmt::format(".br\n.B wilt {}\n", verb.name);
  for (const OptionText& one : verb.options) {
    if (!one.positional) continue;
    const std::string name = fmt::format("\\fI{}\\fR", escaped(one.names.front()));
    text += fmt::format("{}{}\n", one.required ? name : "[" + name + "]", one.repeatable ? " ..." : "");
  }
  return text + "[\\fIoptions\\fR]\n";
}

std::string settings_list() {
  std::string text =
      ".SH SETTINGS\nKeys of \\fB\\-\\-set\\fR and of the files that \\fB\\-\\-config\\fR takes. Defaults in "
      "brackets are those of a leaf of no species;\n.B wilt simulate maple \\-\\-print\\-config\nlists a "
      "species' own.\n";
  for (const SettingText& setting : list_settings(default_config(species("generic"))))
    text += fmt::format(".TP\n\\fB{}\\fR ({})\n{}{}; {}\n", escaped(setting.key), escaped(setting.value),
                        escaped(setting.help), setting.unit.empty() ? "" : escaped(" [" + setting.unit + "]"),
                        escaped(setting.allowed));
  return text;
}

}  // namespace

std::string manual(const CommandLine& line) {
  std::string text = fmt::format(
      ".\\\" Made by `wilt \\-\\-man`.\n.TH WILT 1 \"\" \"wilt {}\" \"User Commands\"\n.SH NAME\nwilt \\- "
      "makes "
      "leaves wither\n.SH SYNOPSIS\n.B wilt\n[\\fIoptions\\fR] \\fIcommand\\fR\n",
      version());
  for (const VerbText& verb : line.verbs) text += synopsis(verb);
  text += ".SH DESCRIPTION\n" + paragraph(line.introduction) + examples(line.examples);
  text += ".SH OPTIONS\nEvery command takes these.\n" + options(line.options);
  text += ".SH COMMANDS\n";
  for (const VerbText& verb : line.verbs)
    text += fmt::format(".SS wilt {}\n{}{}{}", verb.name, paragraph(verb.summary), examples(verb.examples),
                        options(verb.options));
  return text + settings_list() + kExitStatus;
}

}  // namespace wilt::cli
