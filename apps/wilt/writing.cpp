#include "writing.hpp"

#include <fmt/format.h>

#include "interrupts.hpp"

namespace wilt::cli {

void Writing::file(const std::string& path, const std::function<void(const std::string& path)>& write) {
  if (path.empty()) return;
  try {
    if (interrupted()) throw Error(ErrorCode::interrupted, "interrupted while writing");
    write(path);
    terminal_.say("wrote " + path);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::interrupted && error.code() != ErrorCode::output) throw;
    left_out_.push_back(path);
    if (!first_) first_ = error;
  }
}

std::optional<Error> Writing::failure() const {
  if (!first_ || (left_out_.size() == 1 && first_->code() == ErrorCode::output)) return first_;
  return Error(first_->code(),
               fmt::format("{}; not written: '{}'", first_->what(), fmt::join(left_out_, "', '")));
}

}  // namespace wilt::cli
