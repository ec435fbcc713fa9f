// A plan of many leaves, for Python.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "wilt/batch/batch.hpp"
#include "wilt/batch/plan.hpp"
#include "wilt/core/monitor.hpp"

namespace wilt::python {

/// A plan of a batch (docs/batches.md): len(plan) leaves, each of which depends on the plan and its number
/// alone. Functions with a directory make what `wilt batch PLAN -o DIRECTORY` makes there, byte for byte; any
/// number of processes on any number of machines may work on one directory. Of one plan object, one thread at
/// a time does.
class PlanObject {
 public:
  explicit PlanObject(Plan plan) : plan_(std::move(plan)) {}

  const Plan& plan() const { return plan_; }

  /// "whole", "failed" or "missing". Raises ValueError when the item is there, but of another plan or
  /// version.
  std::string state(int item, const std::filesystem::path& directory);

  /// Whether the item is whole. Raises as `state` does.
  bool is_done(int item, const std::filesystem::path& directory);

  /// Makes the item unless it is whole or has failed: {"item", "state", "reason"}, the reason of one that has
  /// failed. Raises OSError when the directory takes no more.
  std::string run_item(int item, const std::filesystem::path& directory, const Monitor& monitor);

  /// Records that the item cannot be made.
  void record_failure(int item, const std::filesystem::path& directory, const std::string& reason);

  /// Forgets that the item has failed, so that it will be tried again.
  void forget_failure(int item, const std::filesystem::path& directory);

  /// When every item is whole or has failed: writes the manifest and the layouts of the plan, and returns
  /// True.
  bool finish(const std::filesystem::path& directory, const Monitor& monitor);

 private:
  Batch& batch(const std::filesystem::path& directory);

  Plan plan_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Batch>> batches_;  // by directory
};

}  // namespace wilt::python
