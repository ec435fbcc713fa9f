// Long computations: other Python threads go on, and Ctrl-C ends them.
#pragma once

#include <functional>

#include "wilt/core/monitor.hpp"

namespace wilt::python {

/// Calls work(monitor) without Python's lock, so that it must not touch Python's objects. Ctrl-C makes the
/// monitor say so and raises KeyboardInterrupt in the end; signals are looked at twenty times a second at
/// most.
void computing(const std::function<void(const Monitor& monitor)>& work);

}  // namespace wilt::python
