// A whole run: leaf, veins, simulation, files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load_leaf.hpp"
#include "terminal.hpp"
#include "wilt/core/image.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/report.hpp"
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

inline constexpr int kPictureWidth = 960, kPictureHeight = 720;

/// Throws unless `path` has an extension that write_result knows, and its folder exists: said before the
/// work.
void check_result_path(const std::string& path);

/// Writes one result by its extension: .glb (all frames), .obj (the last frame), .png (a picture of it).
void write_result(const std::string& path, const WitheredLeaf& withered, Terminal& terminal);

/// The text of report.json.
std::string report_of(const WitheredLeaf& withered);

/// The result as `wilt render` would read it from its .glb.
GlbFile result_file(const WitheredLeaf& withered);

/// A picture of a frame, lying on a table.
Image picture_of(const GlbFile& file, int frame, int width, int height, Terminal& terminal);

/// Throws Error{output} unless `path` can become a file: its folder exists and may be written to.
void check_writable(const std::string& path);

}  // namespace wilt::cli
