// What went wrong, as Python says it.
#pragma once

#include <filesystem>
#include <functional>

namespace wilt::python {

/// wilt::Error becomes ValueError (configuration, input), OSError (output), RuntimeError (simulation) or
/// KeyboardInterrupt, with its message.
void translate_errors();

/// Calls read(), whose complaint about an input is FileNotFoundError where there is no such file.
void reading(const std::filesystem::path& file, const std::function<void()>& read);

}  // namespace wilt::python
