// The command line as data, read from CLI11's definitions: what the manual and the completions are made of.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace wilt::cli {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; a positional's one name: "LEAF"
  std::string value;               ///< what it takes: "FILE", "DIR", "N"; empty for a flag
  std::string description;
  std::vector<std::string> words;  ///< what a shell may offer for the value; beside files where it is a FILE
  bool positional = false, required = false, repeatable = false;

  bool takes_files() const { return value == "FILE"; }
  bool takes_folders() const { return value == "DIR"; }
};

struct VerbText {
  std::string name, summary;
  std::vector<std::string> examples;  ///< a line each
  std::vector<OptionText> options;
};

struct CommandLine {
  std::string introduction;
  std::vector<std::string> examples;
  std::vector<OptionText> options;  ///< that every verb takes
  std::vector<VerbText> verbs;
};

/// `app` is read only; CLI11 shows an option's checks to nobody who may not change them.
CommandLine describe(CLI::App& app);

}  // namespace wilt::cli
