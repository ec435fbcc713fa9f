// Completions for shells.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace wilt::cli {

/// The shells that completion() knows: bash, fish, zsh.
const std::vector<std::string>& completed_shells();

/// The script that the shell reads.
std::string completion(const CommandLine& line, const std::string& shell);

}  // namespace wilt::cli
