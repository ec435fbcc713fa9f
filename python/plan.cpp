// wilt.Plan: the items of a batch, one by one.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "plan_object.hpp"
#include "wilt/batch/item_files.hpp"

namespace wilt::python {

using Lock = std::lock_guard<std::mutex>;

Batch& PlanObject::batch(const std::filesystem::path& directory) {
  std::unique_ptr<Batch>& batch = batches_[directory.string()];
  if (!batch) batch = std::make_unique<Batch>(plan_, directory);
  return *batch;
}

std::string PlanObject::state(int item, const std::filesystem::path& directory) {
  const Lock lock(mutex_);
  switch (batch(directory).state(item)) {
    case ItemState::whole:
      return "whole";
    case ItemState::failed:
      return "failed";
    default:
      return "missing";
  }
}

bool PlanObject::is_done(int item, const std::filesystem::path& directory) {
  return state(item, directory) == "whole";
}

std::string PlanObject::run_item(int item, const std::filesystem::path& directory, const Monitor& monitor) {
  const Lock lock(mutex_);
  Batch& here = batch(directory);
  const bool whole = here.make(item, monitor) == ItemState::whole;
  return nlohmann::json{
      {"item", item}, {"state", whole ? "whole" : "failed"}, {"reason", whole ? "" : here.failure(item)}}
      .dump();
}

void PlanObject::record_failure(int item, const std::filesystem::path& directory, const std::string& reason) {
  const Lock lock(mutex_);
  batch(directory).record_failure(item, ErrorCode::simulation, reason);
}

void PlanObject::forget_failure(int item, const std::filesystem::path& directory) {
  const Lock lock(mutex_);
  batch(directory).forget_failure(item);
}

bool PlanObject::finish(const std::filesystem::path& directory, const Monitor& monitor) {
  const Lock lock(mutex_);
  return batch(directory).finish(monitor);
}

namespace {

using Path = std::filesystem::path;

// Of an item that the plan has, without Python's lock; `act` takes the monitor.
template <class Act>
void working(const PlanObject& plan, int item, const Act& act) {
  if (item < 0 || item >= plan.plan().count())
    throw py::index_error(fmt::format("item {}; the plan has 0 to {}", item, plan.plan().count() - 1));
  computing(act);
}

std::shared_ptr<PlanObject> read(const Path& path) {
  std::shared_ptr<PlanObject> plan;
  reading(path, [&] { plan = std::make_shared<PlanObject>(read_plan(path)); });
  return plan;
}

py::dict chosen(const PlanObject& self, int item) {
  std::string text;
  working(self, item, [&](const Monitor&) { text = chosen_json(self.plan().item(item)); });
  return from_json(text);
}

std::string state(PlanObject& self, int item, const Path& directory) {
  std::string found;
  working(self, item, [&](const Monitor&) { found = self.state(item, directory); });
  return found;
}

bool is_done(PlanObject& self, int item, const Path& directory) {
  bool done = false;
  working(self, item, [&](const Monitor&) { done = self.is_done(item, directory); });
  return done;
}

py::dict run_item(PlanObject& self, int item, const Path& directory) {
  std::string report;
  working(self, item, [&](const Monitor& monitor) { report = self.run_item(item, directory, monitor); });
  return from_json(report);
}

void record_failure(PlanObject& self, int item, const Path& directory, const std::string& reason) {
  working(self, item, [&](const Monitor&) { self.record_failure(item, directory, reason); });
}

void forget_failure(PlanObject& self, int item, const Path& directory) {
  working(self, item, [&](const Monitor&) { self.forget_failure(item, directory); });
}

bool finish(PlanObject& self, const Path& directory) {
  bool finished = false;
  computing([&](const Monitor& monitor) { finished = self.finish(directory, monitor); });
  return finished;
}

}  // namespace

void bind_plan(py::module_& m) {
  namespace d = docs::PlanObject;
  const py::arg item("item"), directory("directory");
  py::class_<PlanObject, std::shared_ptr<PlanObject>>(m, "Plan", d::self)
      .def(py::init([](const std::string& toml, const Path& folder) {
             return std::make_shared<PlanObject>(Plan(toml, "plan", folder));
           }),
           py::arg("toml"), py::arg_v("folder", Path(), "''"), docs::Plan::Plan)
      .def_static("read", read, py::arg("path"), docs::read_plan)
      .def("__len__", [](const PlanObject& self) { return self.plan().count(); })
      .def_property_readonly(
          "text", [](const PlanObject& self) { return self.plan().text(); }, docs::Plan::text)
      .def("chosen", chosen, item, docs::Item::chosen)
      .def("state", state, item, directory, d::state)
      .def("is_done", is_done, item, directory, d::is_done)
      .def("run_item", run_item, item, directory, d::run_item)
      .def("record_failure", record_failure, item, directory, py::arg("reason"), d::record_failure)
      .def("forget_failure", forget_failure, item, directory, d::forget_failure)
      .def("finish", finish, directory, d::finish);
}

}  // namespace wilt::python
