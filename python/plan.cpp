// wilt.Plan: the items of a batch, one by one.
#include "wilt/batch/plan.hpp"

#include <map>
#include <memory>
#include <mutex>

#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "wilt/batch/batch.hpp"
#include "wilt/batch/item_files.hpp"

namespace wilt::python {
namespace {

namespace fs = std::filesystem;

/// A plan with the folders that its items were asked for in. One call at a time: threads wait for each other.
class PlanObject {
 public:
  explicit PlanObject(Plan plan) : plan_(std::move(plan)) {}

  const Plan& plan() const { return plan_; }

  /// Calls work(batch, monitor) without Python's lock.
  template <class Work>
  void with_batch(const fs::path& directory, const Work& work) {
    computing([&](const Monitor& monitor) {
      const std::lock_guard<std::mutex> one(mutex_);
      std::unique_ptr<Batch>& batch = batches_[fs::absolute(directory).string()];
      if (!batch) batch = std::make_unique<Batch>(plan_, directory);
      work(*batch, monitor);
    });
  }

 private:
  Plan plan_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Batch>> batches_;
};

void check_number(const PlanObject& self, int item) {
  if (item < 0 || item >= self.plan().count())
    throw py::index_error("the plan has the items 0 to " + std::to_string(self.plan().count() - 1));
}

py::dict describe(const PlanObject& self, int number) {
  check_number(self, number);
  const Item item = self.plan().item(number);
  py::dict description;
  description["item"] = item.number;
  description["leaf"] = item.leaf.leaf;
  description["chosen"] = from_json(chosen_json(item));
  description["config"] = from_json(to_json(item.config));
  return description;
}

py::dict run_item(PlanObject& self, int item, const fs::path& directory, bool retry) {
  check_number(self, item);
  ItemState state = ItemState::missing;
  std::string reason;
  self.with_batch(directory, [&](Batch& batch, const Monitor& monitor) {
    if (retry) batch.forget_failure(item);
    state = batch.make(item, monitor);
    if (state == ItemState::failed) reason = batch.failure(item);
  });
  py::dict result;
  result["item"] = item;
  result["state"] = state == ItemState::whole ? "whole" : "failed";
  if (state == ItemState::failed) result["reason"] = reason;
  return result;
}

bool is_done(PlanObject& self, int item, const fs::path& directory) {
  check_number(self, item);
  bool done = false;
  self.with_batch(directory,
                  [&](Batch& batch, const Monitor&) { done = batch.state(item) != ItemState::missing; });
  return done;
}

void record_failure(PlanObject& self, int item, const fs::path& directory, const std::string& reason) {
  check_number(self, item);
  self.with_batch(directory, [&](Batch& batch, const Monitor&) {
    batch.record_failure(item, ErrorCode::simulation, reason);
  });
}

bool finish(PlanObject& self, const fs::path& directory) {
  bool finished = false;
  self.with_batch(directory, [&](Batch& batch, const Monitor& monitor) { finished = batch.finish(monitor); });
  return finished;
}

}  // namespace

void bind_plan(py::module_& m) {
  namespace d = docs::Batch;
  py::class_<PlanObject>(m, "Plan", docs::Plan::self)
      .def(py::init([](const std::string& toml, const fs::path& folder) {
             return std::make_unique<PlanObject>(Plan(toml, "plan", folder));
           }),
           py::arg("toml"), py::arg_v("folder", fs::path(), "''"), docs::Plan::Plan)
      .def_static(
          "read",
          [](const fs::path& path) {
            std::unique_ptr<PlanObject> plan;
            reading(path, [&] { plan = std::make_unique<PlanObject>(read_plan(path)); });
            return plan;
          },
          py::arg("path"), docs::read_plan)
      .def("__len__", [](const PlanObject& self) { return self.plan().count(); })
      .def("item", describe, py::arg("item"), docs::Plan::item)
      .def("run_item", run_item, py::arg("item"), py::arg("directory"), py::arg("retry") = false, d::make)
      .def("is_done", is_done, py::arg("item"), py::arg("directory"), d::state)
      .def("record_failure", record_failure, py::arg("item"), py::arg("directory"), py::arg("reason"),
           d::record_failure)
      .def("finish", finish, py::arg("directory"), d::finish);
}

}  // namespace wilt::python
