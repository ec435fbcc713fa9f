#include "random_settings/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "wilt/core/error.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/clip.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/simulation/watchdog.hpp"
#include "wilt/water/dehydration.hpp"

namespace wilt::random_settings {
namespace {

// Round-off of sums of a few hundred numbers, with room.
constexpr double kRoundOff = 1e-9;
struct Inspection {
  const Config& config;
  const Leaf& leaf;
  const SimulationResult& result;
  Outcome& outcome;

  void expect(bool good, const std::string& what) const {
    if (!good && outcome.kind != "bad") outcome.kind = "bad", outcome.reason = what;
  }
  void steps() const;
  void frames() const;
  void water() const;
  double loss_weights() const;
  bool dry_cells() const;
};

void Inspection::steps() const {
  for (const StepRow& step : result.steps) {
    if (!step.converged && !result.completed) continue;  // the one that stopped the run
    const std::string at = fmt::format("iteration {}: ", step.iteration);
    expect(step.converged, at + "not converged, but the run went on");
    expect(step.dt > 0.0 && step.dt <= config.dt, at + fmt::format("a step of {}", step.dt));
    for (const double value : {step.residual, step.kinetic, step.elastic, step.bending, step.water})
      expect(std::isfinite(value) && value >= 0.0, at + fmt::format("a figure is {}", value));
    expect(step.residual <= config.solver.tolerance * (1.0 + kRoundOff),
           at + fmt::format("a residual of {}", step.residual));
    outcome.residual = std::max(outcome.residual, step.residual / config.solver.tolerance);
    const double mass = step.water + result.steps.front().water * (1.0 / config.mass.water_fraction - 1.0);
    outcome.motion =
        std::max(outcome.motion, std::sqrt(2.0 * step.kinetic / mass) * config.dt / kWorkingLength);
    outcome.energy = std::max(outcome.energy, step.elastic + step.bending);
    outcome.halved += step.dt < config.dt ? 1 : 0;
  }
}

void Inspection::frames() const {
  const EdgeData<double> rest = edge_lengths(leaf.mesh, leaf.positions);
  for (const Frame& frame : result.frames) {
    const std::string at = fmt::format("frame of iteration {}: ", frame.iteration);
    expect(frame.positions.allFinite() && frame.stalk.allFinite(), at + "positions are not finite");
    for (const Eigen::VectorXd* share : {&frame.water_fraction, &frame.dryness})
      expect(share->allFinite() && share->minCoeff() >= 0.0 && share->maxCoeff() <= 1.0,
             at + fmt::format("shares from {} to {}", share->minCoeff(), share->maxCoeff()));
    const EdgeData<double> now = edge_lengths(leaf.mesh, frame.positions);
    for (const EdgeId e : leaf.mesh.edges())
      outcome.strain = std::max(outcome.strain, std::abs(now[e] / rest[e] - 1.0));
  }
  for (const FrameMetrics& m : result.metrics) {
    for (const double value : {m.wrinkle, m.curl, m.area_ratio, m.projected_area_ratio, m.max_strain})
      expect(std::isfinite(value), fmt::format("frame of iteration {}: a metric is {}", m.iteration, value));
  }
}

// Whether a cell may have reached the least water that cells keep (w / b = f / (1 - f), and b is at least
// that of the lightest cell).
bool Inspection::dry_cells() const {
  const double f = result.frames.back().water_fraction.minCoeff();
  return f / (1.0 - f) * (1.0 - config.mass.water_fraction) * config.mass.min < 1.01e-3;
}

// The sum over the vertices of what water.dry_region multiplies their loss by: a ray straight up that crosses
// an odd number of sides begins inside.
double Inspection::loss_weights() const {
  const std::vector<double>& corners = config.water.dry_region;
  const double length = leaf_length(leaf);
  double sum = 0.0;
  for (Eigen::Index v = 0; v < leaf.positions.rows(); ++v) {
    const double x = leaf.positions(v, 0) / length, y = leaf.positions(v, 1) / length;
    bool inside = false;
    for (std::size_t k = 0, n = corners.size(); k < n; k += 2) {
      const double x1 = corners[k], x2 = corners[(k + 2) % n];
      const double y1 = corners[k + 1], y2 = corners[(k + 3) % n];
      if ((x1 <= x) != (x2 <= x) && y1 + (x - x1) / (x2 - x1) * (y2 - y1) > y) inside = !inside;
    }
    sum += inside ? config.water.dry_factor : 1.0;
  }
  return sum;
}

// Oracle: the rate of the table, of which no cell loses more; all of it where no cell is dry. The printed
// permeation makes and loses water; there only the sign and the size of the total are known.
void Inspection::water() const {
  const bool cell = config.model == "cell";
  DehydrationOptions air;
  air.celsius = config.water.temperature_c;
  air.humidity = config.water.humidity;
  air.table_rate = config.water.loss_rate;
  const double n = leaf.mesh.num_vertices(), weights = loss_weights();
  const double rate = weights / n *
                      (cell ? static_cast<double>(config.reference.vertices) * dehydration_rate(air)
                            : n * config.water.loss_rate);
  if (!cell && result.note.empty()) return;
  const bool all_of_it = !dry_cells();
  for (std::size_t k = 1; k < result.steps.size(); ++k) {
    if (!result.steps[k].converged) continue;
    const double before = result.steps[k - 1].water, lost = before - result.steps[k].water;
    const double asked = rate * config.dt;
    const double amiss = all_of_it ? std::abs(lost - asked) : std::max({0.0, -lost, lost - asked});
    outcome.imbalance = std::max(outcome.imbalance, amiss / std::max(before, asked));
  }
  expect(outcome.imbalance <= kRoundOff, fmt::format("water out of balance by {}", outcome.imbalance));
}

void inspect(const Config& config, const Leaf& leaf, const SimulationResult& result, Outcome& outcome) {
  const Inspection inspection{config, leaf, result, outcome};
  outcome.steps = static_cast<int>(result.steps.size());
  outcome.kind = result.completed ? "good" : "stopped";
  outcome.reason = result.stop_reason;
  inspection.expect(!result.frames.empty() && result.frames.front().iteration == 0, "no frame at rest");
  if (result.completed)
    inspection.expect(
        outcome.steps == config.iterations && result.frames.back().iteration == config.iterations,
        fmt::format("{} steps of {}", outcome.steps, config.iterations));
  else
    inspection.expect(!result.stop_reason.empty(), "stopped without a reason");
  inspection.steps();
  inspection.frames();
  inspection.water();
  inspection.expect(!result.completed || outcome.strain <= kLargestStretch,
                    fmt::format("an edge strained by {}", outcome.strain));
}

}  // namespace

Outcome run(const Draw& draw) {
  Outcome outcome;
  const Config& config = draw.config;
  try {
    const Species& preset = species(config.species);
    const Leaf leaf =
        make_leaf(preset.name, static_cast<int>(config.vertices), static_cast<std::uint64_t>(config.seed));
    const Venation venation = find_venation(leaf, preset.secondary, venation_options(config));
    const SimulationResult result = simulate(leaf, venation, config);
    inspect(config, leaf, result, outcome);
    const std::string glb =
        glb_bytes(make_clip(leaf, venation, config, result.frames), {config.clip.seconds});
    if (glb.empty()) outcome.kind = "bad", outcome.reason = "an empty file";
  } catch (const Error& error) {
    const bool known = error.code() == ErrorCode::configuration || error.code() == ErrorCode::input;
    outcome.kind = known ? "refused" : "bad";
    outcome.reason = error.what();
  } catch (const std::exception& error) {
    outcome.kind = "bad";
    outcome.reason = error.what();
  }
  return outcome;
}

}  // namespace wilt::random_settings
