// What a whole run computes: leaf, veins, the withering.
#pragma once

#include <string>

#include "wilt/core/monitor.hpp"
#include "wilt/output/report.hpp"
#include "wilt/run/leaf_request.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

/// A leaf, what was done with it and the time that each stage took.
struct WitheredLeaf {
  Leaf leaf;
  Venation venation;
  Config config;
  SimulationResult result;
  Timings timings;
};

/// The leaf at rest with its veins; there is no result yet. Throws as load_leaf() and load_veins() do.
WitheredLeaf prepare(const LeafRequest& request, const Config& config, const Monitor& monitor = {});

/// The text of report.json.
std::string report_of(const WitheredLeaf& withered);

}  // namespace wilt
