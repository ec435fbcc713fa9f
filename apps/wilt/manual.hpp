// The manual page.
#pragma once

#include <string>

#include "command_line.hpp"

namespace wilt::cli {

/// wilt(1) in the macros of man(7): every verb and option, the settings, exit codes, files.
std::string manual(const CommandLine& line);

}  // namespace wilt::cli
