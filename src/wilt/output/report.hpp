// What a run did, as figures: report.json and forces.csv.
#pragma once

#include <string>

#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// Wall-clock seconds of the stages; measured by the caller.
struct Timings {
  double leaf = 0.0, geodesics = 0.0, embedding = 0.0, venation = 0.0, simulation = 0.0, output = 0.0;
};

/// report.json: {"wilt", "config", "leaf", "timings_s", "steps", "frames", "metrics", "positions_hash"}.
///
/// "leaf": name, species, seed, vertices, faces, length (metres), boundary_vertices, tips (their number) and
/// notes. "frames" and "metrics" (those of the last frame) give "curl" in degrees, "wrinkle" in units of the
/// leaf's length. A run that stopped early also has "stopped": the reason. `config` is JSON text. A number
/// that is not finite becomes null.
std::string report_json(const Leaf& leaf, const Venation& venation, const SimulationResult& result,
                        const std::string& config, const Timings& timings);

/// forces.csv: iteration,region,elastic,damping,swelling,external,water,pressure; working units, nine digits.
std::string forces_csv(const SimulationResult& result);

}  // namespace wilt
