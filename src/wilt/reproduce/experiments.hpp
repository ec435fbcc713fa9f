// The runs that the figures are made of: each is computed once and kept.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// A leaf at rest with its veins: what several experiments share.
struct Subject {
  Leaf leaf;
  Venation venation;
};

/// A leaf that withered.
struct Experiment {
  const Subject& subject;
  Config config;
  SimulationResult result;  ///< frames at the iterations 0, 10, .. 100
};

/// Settings that differ from the species' defaults: {"external.scale", "0"}.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Leaves and runs by what they are made from. Deterministic on any number of threads.
class Experiments {
 public:
  static constexpr int kIterations = 100;
  static constexpr int kFrames = 11;

  /// `vertices` of every leaf, 200 to 1,000,000; `seed` varies the individuals. Only the monitor's
  /// `cancelled` and `note` are used; it must outlive this object.
  Experiments(int vertices, std::uint64_t seed, const Monitor& monitor);

  /// One of the six species. The reference stays valid as long as this object.
  const Subject& leaf(const std::string& species);

  /// `model` is "paper" or "cell". A run that stops early is kept as it is and noted. Throws
  /// Error{configuration} for wrong overrides, Error{interrupted} when the user asks to stop.
  const Experiment& run(const std::string& species, const std::string& model,
                        const Overrides& overrides = {});

  /// The models of which run() has given a run that stopped early, since the last call.
  std::set<std::string> take_broken();

  /// The configuration of such a run.
  Config config(const std::string& species, const std::string& model, const Overrides& overrides = {}) const;

 private:
  std::unique_ptr<Experiment> compute(const std::string& species, const Config& resolved);

  int vertices_;
  std::uint64_t seed_;
  Monitor quiet_;
  std::map<std::string, std::unique_ptr<Subject>> leaves_;
  std::set<std::string> broken_;
  std::map<std::string, std::unique_ptr<Experiment>> runs_;  // by the resolved configuration
};

/// A number as a value of Overrides: the shortest decimal form that reads back.
std::string setting_text(double value);

}  // namespace wilt
