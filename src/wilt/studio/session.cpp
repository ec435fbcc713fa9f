#include "wilt/studio/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wilt/core/error.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/clip.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/report.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

// States that the texture must serve while it is not known which one will be the last.
LeafPaint painted(const Leaf& leaf, const Venation& venation, Config config, int texels) {
  config.texture.size = texels;
  std::vector<Eigen::VectorXd> states;
  for (const double dryness : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
    states.push_back(Eigen::VectorXd::Constant(leaf.positions.rows(), dryness));
  return LeafPaint(leaf, venation, config, states);
}

std::size_t nearest_on_margin(const MarginProfile& margin, double s) {
  if (!(s >= 0.0 && s <= margin.perimeter))
    throw Error(ErrorCode::input,
                fmt::format("a tip at {:.4g} m along the margin is not on it; it is {:.4g} m long", s,
                            margin.perimeter));
  Eigen::Index nearest = 0;
  (margin.s.array() - s).abs().minCoeff(&nearest);
  return static_cast<std::size_t>(nearest);
}

Venation found_venation(const Leaf& leaf, const VeinEdits& edits, const Config& config) {
  const VenationOptions options = venation_options(config);
  return edited_venation(leaf, find_venation(leaf, species(config.species).secondary, options), edits,
                         options);
}

}  // namespace

Venation edited_venation(const Leaf& leaf, const Venation& found, const VeinEdits& edits,
                         const VenationOptions& options) {
  if (edits.added.empty() && edits.removed.empty()) return found;
  std::vector<bool> gone(found.tips.size(), false);
  for (const double s : edits.removed) {
    const auto nearest =
        std::min_element(found.tips.begin(), found.tips.end(),
                         [s](const Tip& a, const Tip& b) { return std::abs(a.s - s) < std::abs(b.s - s); });
    gone[static_cast<std::size_t>(nearest - found.tips.begin())] = true;
  }
  std::vector<DrawnVein> drawn;
  for (std::size_t i = 0; i < found.veins.size(); ++i) {
    const Vein& vein = found.veins[i];
    const int primary = vein.order == 1 ? static_cast<int>(i) : vein.parent;
    const int tip = found.veins[static_cast<std::size_t>(primary)].tip;
    if (gone[static_cast<std::size_t>(tip)]) continue;
    drawn.push_back({vein.order, vein.path.points, static_cast<int>(i)});
  }
  for (const double s : edits.added) {
    const VertexId vertex = found.margin.vertices[nearest_on_margin(found.margin, s)];
    drawn.push_back({1, {surface_point(leaf.mesh, vertex)}, -1});
  }
  return with_drawn_veins(leaf, found, drawn, options);
}

StudioSession::StudioSession(Leaf leaf, const VeinEdits& edits, std::string preset,
                             std::vector<Assignment> given, const std::string& toml)
    : leaf_(std::move(leaf)),
      preset_(std::move(preset)),
      given_(std::move(given)),
      venation_(found_venation(leaf_, edits, resolved(toml))),
      simulation_(std::make_unique<Simulation>(leaf_, venation_, resolved(toml))),
      first_water_(simulation_->model().water().sum()),
      paint_(painted(leaf_, venation_, config(), 0)) {}

StudioSession::~StudioSession() = default;

Config StudioSession::resolved(const std::string& toml) const {
  return resolve_config(preset_, toml, "settings", given_);
}

void StudioSession::start(const std::string& toml) {
  begin(resolved(toml));
}

void StudioSession::begin(const Config& config) {
  simulation_ = std::make_unique<Simulation>(leaf_, venation_, config);
  first_water_ = simulation_->model().water().sum();
}

void StudioSession::rewind(int iteration) {
  if (iteration < 0 || iteration > simulation_->iteration())
    throw Error(ErrorCode::configuration, fmt::format("iteration {} must be from 0 to {}, the last one done",
                                                      iteration, simulation_->iteration()));
  Config kept = config();
  kept.changes.erase(
      std::remove_if(kept.changes.begin(), kept.changes.end(),
                     [iteration](const Change& change) { return change.iteration > iteration; }),
      kept.changes.end());
  begin(kept);
  while (simulation_->iteration() < iteration && !simulation_->ended()) simulation_->step();
}

void StudioSession::paint_texture(int size) {
  paint_ = painted(leaf_, venation_, config(), size);
}

std::string StudioSession::file(const std::string& kind) const {
  if (kind == "toml") return to_toml(config(), true);
  if (kind == "veins.json") return veins_json(leaf_, venation_);
  const SimulationResult result = simulation_->finish();
  if (kind == "forces.csv") return forces_csv(result);
  if (kind == "report.json") return report_json(leaf_, venation_, result, to_json(config()), {});
  if (kind == "glb") {
    GlbOptions options;
    options.seconds = config().clip.seconds;
    return glb_bytes(make_clip(leaf_, venation_, config(), result.frames), options);
  }
  throw Error(
      ErrorCode::configuration,
      fmt::format(
          "'{}' is no file of the studio; there are glb, forces.csv, toml, report.json and veins.json",
          kind));
}

}  // namespace wilt
