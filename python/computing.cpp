#include "computing.hpp"

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

namespace wilt::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

// Asks Python whether a signal's handler has raised something, and keeps that.
class Signals {
 public:
  bool raised() {
    if (raised_) return true;
    if (Clock::now() < next_look_) return false;
    next_look_ = Clock::now() + kPause;
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }
  void raise_in_python() const {
    if (raised_) throw py::error_already_set(*raised_);
  }

 private:
  static constexpr std::chrono::milliseconds kPause{50};

  Clock::time_point next_look_ = Clock::now() + kPause;
  std::optional<py::error_already_set> raised_;
};

}  // namespace

void computing(const std::function<void(const Monitor&)>& work) {
  Signals signals;
  Monitor monitor;
  monitor.cancelled = [&signals] { return signals.raised(); };
  try {
    const py::gil_scoped_release released;
    work(monitor);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::interrupted) signals.raise_in_python();
    throw;
  }
  signals.raise_in_python();
}

}  // namespace wilt::python
