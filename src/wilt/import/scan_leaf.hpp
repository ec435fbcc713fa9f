// A scan as a leaf. Inside the import room only.
#pragma once

#include <string>
#include <vector>

#include "wilt/import/read_leaf.hpp"

namespace wilt::detail {

struct Scan {
  Points3 points;                  ///< #P x 3, Z up
  bool y_up = false;               ///< whether the file's y is up, as in mesh files: for messages
  std::vector<std::string> notes;  ///< of reading it
};

/// Cleans the points, lays the largest piece out in the plane, fits a smooth surface, finds the margin, cuts
/// off a stalk and finds the petiole, meshes, and places the leaf in its frame. Says in Leaf::notes how good
/// the scan is. Throws Error{input} with figures when it is too poor (scan_limits.hpp). Deterministic,
/// whatever the order of the points.
Leaf leaf_from_scan(Scan scan, const std::string& name, const ReadOptions& options, const Monitor& monitor);

}  // namespace wilt::detail
