// wilt.Simulation: a leaf that withers step by step.
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "run_object.hpp"
#include "simulation.hpp"
#include "veins.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt::python {
namespace {

constexpr std::uint64_t kLargestConfig = std::uint64_t{1} << 20;  // bytes

using Shared = std::shared_ptr<RunObject>;

struct Toml {
  std::string text, source;
};

// A str with '=' in it is the text itself; everything else names a file.
Toml toml_of(const py::object& config) {
  if (config.is_none()) return {};
  if (py::isinstance<py::str>(config)) {
    const std::string text = config.cast<std::string>();
    if (text.find('=') != std::string::npos) return {text, "config"};
  }
  const auto path = path_of(config);
  Toml toml{"", path.string()};
  reading(path, [&] { toml.text = read_file(path.string(), kLargestConfig); });
  return toml;
}

// `changes` as `change` in a configuration: [{"iteration": n, key: value, ...}, ...].
void add_changes(Config& config, const py::object& changes) {
  for (const py::handle section : changes) {
    if (!py::isinstance<py::dict>(section) || !section.contains("iteration") ||
        !py::isinstance<py::int_>(section["iteration"]))
      throw Error(ErrorCode::configuration,
                  "change takes a list like [{\"iteration\": 40, \"water.humidity\": 0.2}, ...]");
    const auto iteration = section["iteration"].cast<std::int64_t>();
    for (const Assignment& one : assignments_of(section.cast<py::dict>())) {
      if (one.key != "iteration") add_change(config, iteration, one.key, one.value);
    }
  }
}

// The leaf was made with a seed and a size, which stand in the configuration too.
Config config_of(const LeafObject& leaf, const SimulationArguments& arguments) {
  const std::int64_t vertices = leaf.vertices.value_or(0), seed = static_cast<std::int64_t>(leaf.leaf.seed);
  const py::dict settings = arguments.settings.attr("copy")();
  const py::object changes = settings.attr("pop")("change", py::list());
  std::vector<Assignment> assignments = assignments_of(settings);
  assignments.insert(assignments.begin(),
                     {{"vertices", std::to_string(vertices)}, {"seed", std::to_string(seed)}});
  if (arguments.model) assignments.push_back({"model", *arguments.model});
  const Toml toml = toml_of(arguments.config);
  Config config = resolve_config(leaf.leaf.species, toml.text, toml.source, assignments);
  add_changes(config, changes);
  const auto refuse = [](const char* key, std::int64_t asked, std::int64_t made) {
    throw Error(ErrorCode::configuration,
                fmt::format("{0} is {1}, but the leaf was made with {2}; give {0}={1} where it is made", key,
                            asked, made));
  };
  if (config.seed != seed) refuse("seed", config.seed, seed);
  if (config.vertices != 0 && config.vertices != vertices) refuse("vertices", config.vertices, vertices);
  config.vertices = vertices;
  return config;
}

void step(RunObject& run) {
  computing([&run](const Monitor&) { run.step(); });
}

// What is asked for may have to wait for another thread's step, which must not wait for Python meanwhile.
template <class Result>
auto waiting(Result (RunObject::*get)() const) {
  return [get](const RunObject& run) {
    const py::gil_scoped_release released;
    return (run.*get)();
  };
}

std::shared_ptr<StateObject> state(RunObject& run) {
  const py::gil_scoped_release released;
  return run.state();
}

std::shared_ptr<ResultObject> result(RunObject& run) {
  const py::gil_scoped_release released;
  return run.result();
}

py::bytes checkpoint(const RunObject& run) {
  return py::bytes(waiting(&RunObject::checkpoint)(run));
}

void change(RunObject& run, const py::kwargs& settings) {
  const std::vector<Assignment> changes = assignments_of(settings);
  const py::gil_scoped_release released;
  run.change(changes);
}

void restore(RunObject& run, const py::bytes& bytes) {
  const std::string content = bytes;
  computing([&](const Monitor&) { run.restore(content); });
}

}  // namespace

std::shared_ptr<RunObject> make_simulation(const std::shared_ptr<LeafObject>& leaf,
                                           const SimulationArguments& arguments) {
  const std::shared_ptr<VeinsObject>& veins = arguments.veins;
  auto subject = std::make_shared<Subject>(Subject{leaf, veins, config_of(*leaf, arguments)});
  if (!veins)
    subject->veins = find_veins(leaf, subject->config, "");
  else if (veins->leaf != leaf)
    throw Error(ErrorCode::configuration, "the veins are another leaf's; give those of leaf.veins()");
  else
    subject->config.veins = veins->config.veins;
  Shared run;
  computing([&](const Monitor&) { run = std::make_shared<RunObject>(subject); });
  return run;
}

std::shared_ptr<ResultObject> run_to_end(const Shared& run, const py::object& callback) {
  if (callback.is_none()) computing([&run](const Monitor& monitor) { run->run(monitor); });
  while (!waiting(&RunObject::ended)(*run)) {
    step(*run);
    callback(run);
  }
  return result(*run);
}

std::shared_ptr<StateObject> next_state(RunObject& run) {
  const int before = waiting(&RunObject::iteration)(run);
  step(run);
  if (waiting(&RunObject::iteration)(run) == before) throw py::stop_iteration();
  return state(run);
}

py::dict resolved_config(const RunObject& run) {
  return from_json(to_json(waiting(&RunObject::config)(run)));
}

void bind_simulation(py::module_& m) {
  namespace d = docs::RunObject;
  namespace a = docs::SimulationArguments;
  const auto none = py::none();
  const std::string arguments = with_arguments(
      docs::make_simulation,
      {{"model", a::model}, {"veins", a::veins}, {"config", a::config}, {"settings", a::settings}});
  py::class_<RunObject, Shared>(m, "Simulation", d::self)
      .def(py::init([](const std::shared_ptr<LeafObject>& leaf, const std::optional<std::string>& model,
                       const std::shared_ptr<VeinsObject>& veins, const py::object& config,
                       const py::kwargs& settings) {
             return make_simulation(leaf, {model, veins, config, settings});
           }),
           py::arg("leaf").none(false), py::arg("model") = none, py::kw_only(), py::arg("veins") = none,
           py::arg("config") = none, arguments.c_str())
      .def("step", &step, d::step)
      .def("run", &run_to_end, py::arg("callback") = none, docs::run_to_end)
      .def("__iter__", [](const Shared& run) { return run; })
      .def("__next__", &next_state, docs::next_state)
      .def("change", &change, d::change)
      .def("checkpoint", &checkpoint, d::checkpoint)
      .def("restore", &restore, py::arg("checkpoint"), d::restore)
      .def_property_readonly("iteration", waiting(&RunObject::iteration), d::iteration)
      .def_property_readonly("last_iteration", &RunObject::last_iteration, d::last_iteration)
      .def_property_readonly("ended", waiting(&RunObject::ended), d::ended)
      .def_property_readonly("state", &state, d::state)
      .def_property_readonly("result", &result, d::result)
      .def_property_readonly("config", &resolved_config, docs::resolved_config)
      .def_property_readonly(
          "leaf",
          [](const RunObject& run) { return std::const_pointer_cast<LeafObject>(run.subject().leaf); },
          docs::Leaf::self)
      .def_property_readonly(
          "veins",
          [](const RunObject& run) { return std::const_pointer_cast<VeinsObject>(run.subject().veins); },
          docs::Venation::self)
      .def("__repr__", [](const RunObject& run) {
        return fmt::format("<wilt.Simulation of {}: iteration {} of {}>", run.subject().leaf->leaf.name,
                           waiting(&RunObject::iteration)(run), run.last_iteration());
      });
}

}  // namespace wilt::python
