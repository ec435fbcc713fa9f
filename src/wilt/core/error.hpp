// How wilt says that something cannot be done.
#pragma once

#include <stdexcept>
#include <string>

namespace wilt {

/// What went wrong, as a user would sort it; the value is the exit code of the command line.
enum class ErrorCode {
  configuration = 2,  ///< a wrong command line, an unknown key, a value out of range
  input = 3,          ///< a leaf or a file that cannot be used
  simulation = 4,     ///< the simulation could not go on
  output = 5,         ///< a file that cannot be written
  interrupted = 130,  ///< the user asked to stop
};

/// Bad input. The message names the offender, its value, what is allowed and how to mend it.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace wilt
