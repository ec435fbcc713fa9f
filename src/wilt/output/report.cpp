#include "wilt/output/report.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "wilt/core/check.hpp"
#include "wilt/core/version.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

Json leaf_json(const Leaf& leaf, const Venation& venation) {
  int boundary_vertices = 0;
  for (const auto& loop : leaf.mesh.boundary_loops()) boundary_vertices += static_cast<int>(loop.size());
  return {{"name", leaf.name},
          {"species", leaf.species},
          {"seed", leaf.seed},
          {"vertices", leaf.mesh.num_vertices()},
          {"faces", leaf.mesh.num_faces()},
          {"length", leaf_length(leaf)},
          {"boundary_vertices", boundary_vertices},
          {"tips", venation.tips.size()},
          {"notes", leaf.notes}};
}

Json step_json(const StepRow& step) {
  return {{"iteration", step.iteration}, {"dt", step.dt},
          {"newton", step.newton},       {"linear", step.linear},
          {"residual", step.residual},   {"converged", step.converged},
          {"kinetic", step.kinetic},     {"elastic", step.elastic},
          {"bending", step.bending},     {"water", step.water}};
}

Json metrics_json(const FrameMetrics& metrics) {
  return {{"iteration", metrics.iteration},
          {"wrinkle", metrics.wrinkle},
          {"curl", metrics.curl * 180.0 / std::numbers::pi},
          {"area_ratio", metrics.area_ratio},
          {"projected_area_ratio", metrics.projected_area_ratio},
          {"max_strain", metrics.max_strain},
          {"self_intersections", metrics.self_intersections}};
}

}  // namespace

std::string report_json(const Leaf& leaf, const Venation& venation, const SimulationResult& result,
                        const std::string& config, const Timings& timings) {
  WILT_CHECK(Json::accept(config), config);
  Json steps = Json::array(), frames = Json::array();
  for (const StepRow& step : result.steps) steps.push_back(step_json(step));
  for (const FrameMetrics& metrics : result.metrics) frames.push_back(metrics_json(metrics));
  Json report = {{"wilt", version()},
                 {"config", Json::parse(config)},
                 {"leaf", leaf_json(leaf, venation)},
                 {"timings_s",
                  {{"leaf", timings.leaf},
                   {"geodesics", timings.geodesics},
                   {"embedding", timings.embedding},
                   {"venation", timings.venation},
                   {"simulation", timings.simulation},
                   {"output", timings.output}}},
                 {"steps", std::move(steps)},
                 {"frames", std::move(frames)},
                 {"metrics", result.metrics.empty() ? Json::object() : metrics_json(result.metrics.back())},
                 {"positions_hash", result.positions_hash}};
  if (!result.completed) report["stopped"] = result.stop_reason;
  if (!result.note.empty()) report["note"] = result.note;
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string forces_csv(const SimulationResult& result) {
  std::string text = "iteration,region,elastic,damping,swelling,external,water,pressure\n";
  for (const ForceRow& row : result.forces) {
    fmt::format_to(std::back_inserter(text), "{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                   row.iteration, region_name(row.region), row.elastic, row.damping, row.swelling,
                   row.external, row.water, row.pressure);
  }
  return text;
}

}  // namespace wilt
