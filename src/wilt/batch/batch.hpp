// A folder of items: what is whole in it, what is still to be made, and what is made of the whole.
//
//   DIR/items/000017/         an item: item.json and the files of its plan
//   DIR/failed/000017.json    why an item could not be made
//   DIR/manifest.jsonl        a line for every item, when all are there; SHA256SUMS, plan.toml
//   DIR/coco.json, DIR/webdataset/shard-000000.tar ...    the layouts that the plan asks for
//
// An item is made in a hidden folder beside it and renamed when it is whole, so an item's folder is always
// whole. Any number of processes, on any number of machines that share the folder, may work on one batch.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "wilt/batch/plan.hpp"
#include "wilt/batch/prepared_leaves.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/monitor.hpp"

namespace wilt {

class Fingerprints;

enum class ItemState { missing, whole, failed };

class Batch {
 public:
  /// Makes the folder. Refers to the plan, which must outlive it. Throws Error{output}.
  Batch(const Plan& plan, std::filesystem::path folder);
  ~Batch();

  /// Whether the item is there. Throws Error{configuration} when it is there, but of another plan or version
  /// of wilt: nothing is overwritten.
  ItemState state(int item);

  /// Makes the item unless it is whole. An item that cannot be made is recorded as failed, with the reason.
  /// Throws Error{output} when the folder takes no more, Error{interrupted} when the monitor says so.
  ItemState make(int item, const Monitor& monitor = {});

  /// Records that the item cannot be made.
  void record_failure(int item, ErrorCode code, const std::string& reason);
  /// Why it could not be made, or nothing.
  std::string failure(int item) const;
  /// Forgets failures, so that the item will be tried again.
  void forget_failure(int item) const;

  /// When every item of the plan is whole or has failed: writes the manifest and the layouts, unless that was
  /// done, and returns true. Otherwise false. Their bytes do not depend on who made which item when.
  bool finish(const Monitor& monitor = {});

  const Plan& plan() const { return plan_; }
  std::filesystem::path item_folder(int item) const;

 private:
  std::filesystem::path failure_file(int item) const;
  std::pair<ItemState, std::string> find(int item);  ///< with its fingerprint

  const Plan& plan_;
  std::filesystem::path folder_;
  std::unique_ptr<Fingerprints> fingerprints_;
  PreparedLeaves leaves_;
};

}  // namespace wilt
