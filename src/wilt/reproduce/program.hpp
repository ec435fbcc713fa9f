// Running another program and taking what it writes.
#pragma once

#include <string>
#include <vector>

namespace wilt {

struct ProgramOutput {
  bool started = false;  ///< false: there is no such program
  int exit_code = 0;     ///< the signal's number when one ended it
  std::string text;      ///< its standard output
};

/// Runs the program `name`, searched in PATH, in `folder`, and waits for it. Nothing is read by a shell; its
/// standard input is empty, its standard error dropped. It does not get the terminal's Ctrl-C.
ProgramOutput run_program(const std::string& name, const std::vector<std::string>& arguments,
                          const std::string& folder);

}  // namespace wilt
