// What a plan says, as it was read; for inside the batch room only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/batch/distribution.hpp"
#include "wilt/batch/plan.hpp"

namespace wilt::detail {

/// A value that every item gets.
struct Variable {
  std::string key;  ///< "leaf", "water.humidity", "pictures.azimuth"
  Distribution distribution;
};

struct PlanContents {
  std::string text;
  std::filesystem::path folder;  ///< where relative names lie
  std::uint64_t seed = 1;
  int count = 0;
  std::vector<Variable> variables;  ///< by key
  ReadOptions read;                 ///< of leaves that are files
  std::string veins;                ///< of them too
  Outputs outputs;
};

/// Reads and checks a plan. Throws Error{configuration} with source and line.
PlanContents read_contents(std::string_view toml, const std::string& source,
                           const std::filesystem::path& folder);

/// The cells of the grids, in which the last key varies fastest; 1 without a grid.
std::int64_t grid_cells(const PlanContents& plan);

/// "#rrggbb" as sRGB, 0 to 1. Throws Error{configuration}.
Vec3 parse_colour(const std::string& text);

}  // namespace wilt::detail
