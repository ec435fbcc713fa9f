// Writing the files of a run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "terminal.hpp"
#include "wilt/core/error.hpp"

namespace wilt::cli {

/// Writes what it can of several files: one that cannot be written keeps no other from it, and Ctrl-C lets
/// the one that is being written be finished and leaves out the rest.
class Writing {
 public:
  explicit Writing(Terminal& terminal) : terminal_(terminal) {}

  /// Calls write(path), which throws Error{output} or Error{interrupted} when it cannot; other errors pass.
  /// An empty path is no file.
  void file(const std::string& path, const std::function<void(const std::string& path)>& write);

  /// The first failure, with the names of all that was not written.
  std::optional<Error> failure() const;

 private:
  Terminal& terminal_;
  std::vector<std::string> left_out_;
  std::optional<Error> first_;
};

}  // namespace wilt::cli
