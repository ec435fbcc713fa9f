// Leaves at rest with their veins, kept for the next item that wants the same.
#pragma once

#include <list>
#include <string>
#include <utility>

#include "wilt/run/withered_leaf.hpp"

namespace wilt {

/// The last few prepared leaves: items that differ in water or mechanics alone share mesh and veins.
class PreparedLeaves {
 public:
  /// A copy, with the configuration given. Throws as prepare() does.
  WitheredLeaf get(const LeafRequest& request, const Config& config, const Monitor& monitor);

 private:
  static constexpr std::size_t kKept = 4;

  std::list<std::pair<std::string, WitheredLeaf>> leaves_;  // the last used first
};

}  // namespace wilt
