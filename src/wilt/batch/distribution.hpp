// How a value varies from item to item; for inside the batch room only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <toml++/toml.h>

namespace wilt::detail {

enum class Spread { fixed, choice, grid, uniform, normal, latin };

/// A value of a plan. Values are texts as `set` (simulation/config.hpp) takes them.
struct Distribution {
  Spread spread = Spread::fixed;
  std::vector<std::string> values;  ///< of fixed (one), choice and grid
  std::vector<double> weights;      ///< of choice, > 0; empty: all the same
  double a = 0.0, b = 0.0;          ///< uniform and latin: from and to; normal: mean and standard deviation
  double least, most;               ///< what a normal one is kept within, by drawing again
  bool whole = false;               ///< whole numbers: uniform and latin from a to b, both included
};

/// Whether a table says how a value varies, rather than holding further keys.
bool is_distribution(const toml::table& table);

/// From `0.5`, `"maple"`, `true`, `{uniform = [0, 1]}`, `{normal = [20, 4], min = 0, max = 40}`,
/// `{choice = [...], weights = [...]}`, `{grid = [...]}` or `{latin = [0, 1]}`. Throws Error{configuration},
/// without a line.
Distribution parse_distribution(const std::string& key, const toml::node& node);

/// The value of item `item`. `cell`: which value of a grid; `stratum` of `strata`: which part of a Latin
/// hypercube's side.
std::string draw(const Distribution& distribution, const std::string& key, std::uint64_t seed, int item,
                 std::size_t cell, int stratum, int strata);

}  // namespace wilt::detail
