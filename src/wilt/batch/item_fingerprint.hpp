// What an item is made of, in one word; for inside the batch room only.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "wilt/batch/plan.hpp"

namespace wilt {

/// A request as JSON, its files by name.
nlohmann::ordered_json describe(const LeafRequest& request);

/// Fingerprints of items: equal for equal items, whichever machine, folder or time; another version of wilt,
/// another setting, another output or other contents of the leaf's files give another one.
class Fingerprints {
 public:
  explicit Fingerprints(const Outputs& outputs);

  /// SHA-256, 64 hexadecimal digits. Reads the leaf's files once.
  std::string of(const Item& item);

 private:
  const std::string& contents(const std::string& file);

  nlohmann::ordered_json outputs_;
  std::map<std::string, std::string> files_;  // their hashes by name
};

}  // namespace wilt
