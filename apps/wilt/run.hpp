// A whole run: leaf, veins, simulation, files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load_leaf.hpp"
#include "terminal.hpp"
#include "wilt/output/report.hpp"
#include "wilt/render/image.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt::cli {

/// What a run has computed, with the time each stage took.
struct WitheredLeaf {
  Leaf leaf;
  Venation venation;
  Config config;
  SimulationResult result;
  Timings timings;
};

/// Loads the leaf, finds its veins and withers it. The leaf's notes go to the terminal.
WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal);

/// Writes one result by its extension: .glb (all frames), .obj (the last frame).
void write_result(const std::string& path, const WitheredLeaf& withered);

/// The configuration as JSON, the leaf's own name and vertex count as they were resolved.
std::string report_of(const WitheredLeaf& withered);

/// A picture of the leaf at a frame.
Image picture_of(const WitheredLeaf& withered, const Frame& frame, int width, int height, Terminal& terminal);

/// Throws Error{output} unless the folder of `path` exists: said before the work, not after it.
void check_writable(const std::string& path);

}  // namespace wilt::cli
