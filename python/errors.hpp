// What went wrong, as Python says it.
#pragma once

#include <pybind11/pytypes.h>

#include <filesystem>
#include <functional>

namespace wilt::python {

/// wilt::Error becomes ValueError (configuration, input), OSError (output), RuntimeError (simulation) or
/// KeyboardInterrupt, with its message.
void translate_errors();

/// Calls read(), whose complaint about an input is FileNotFoundError where there is no such file.
void reading(const std::filesystem::path& file, const std::function<void()>& read);

/// A str or os.PathLike. Raises TypeError for anything else.
std::filesystem::path path_of(pybind11::handle path);

}  // namespace wilt::python
