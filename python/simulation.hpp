// wilt.Simulation where it touches Python.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "run_object.hpp"

namespace wilt::python {

namespace py = pybind11;

struct SimulationArguments {
  std::optional<std::string> model;  ///< "cell" (the default) or "paper"; wins over `config`
  /// What leaf.veins() found, or none: they are found by the settings veins.*. Those are else the ones that
  /// `veins` was found with.
  std::shared_ptr<VeinsObject> veins;
  /// A file of settings (TOML, as `wilt simulate --print-config` writes it), or a str with '=' in it: its
  /// text. Keyword arguments win over it; seed and vertices are the leaf's.
  py::object config;
  /// See wilt.settings(); water__humidity=0.3, or **{"water.humidity": 0.3}. change=[{"iteration": 40,
  /// "water.humidity": 0.2}]: the steps after iteration 40 have the new value.
  py::kwargs settings;
};

/// The leaf at rest, iteration 0. Raises ValueError for an unknown setting, with the nearest one, and for a
/// value out of range.
std::shared_ptr<RunObject> make_simulation(const std::shared_ptr<LeafObject>& leaf,
                                           const SimulationArguments& arguments);

/// All iterations that are left. callback(simulation), if given, is called after each of them. Ctrl-C raises
/// KeyboardInterrupt after the one that is being done: what was computed is kept, and another call goes on.
std::shared_ptr<ResultObject> run_to_end(const std::shared_ptr<RunObject>& run, const py::object& callback);

/// One iteration, and the state after it. Raises StopIteration when there is none left, or the run has
/// stopped.
std::shared_ptr<StateObject> next_state(RunObject& run);

/// {setting: value}, resolved, with what was changed until now: Simulation(leaf, **simulation.config) is the
/// same simulation again.
py::dict resolved_config(const RunObject& run);

}  // namespace wilt::python
