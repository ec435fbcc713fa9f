#include "wilt/batch/prepared_leaves.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wilt/batch/item_fingerprint.hpp"

namespace wilt {
namespace {

// All that the leaf and its veins depend on.
std::string key_of(const LeafRequest& request, const Config& config) {
  nlohmann::ordered_json key = describe(request);
  const auto settings = nlohmann::ordered_json::parse(to_json(config));
  for (const auto& [name, value] : settings.items()) {
    if (name.rfind("veins.", 0) == 0 || name == "species") key[name] = value;
  }
  return key.dump();
}

}  // namespace

WitheredLeaf PreparedLeaves::get(const LeafRequest& request, const Config& config, const Monitor& monitor) {
  const std::string key = key_of(request, config);
  const auto found =
      std::find_if(leaves_.begin(), leaves_.end(), [&key](const auto& entry) { return entry.first == key; });
  if (found != leaves_.end()) {
    leaves_.splice(leaves_.begin(), leaves_, found);
  } else {
    leaves_.emplace_front(key, prepare(request, config, monitor));
    if (leaves_.size() > kKept) leaves_.pop_back();
  }
  WitheredLeaf leaf = leaves_.front().second;
  leaf.config = config;
  return leaf;
}

}  // namespace wilt
