#include "wilt/mechanics/midpoint_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/argument_checks.hpp"
#include "wilt/mechanics/chebyshev_midpoint.hpp"
#include "wilt/mechanics/leaf_lanes.hpp"

namespace wilt {

using detail::LeafLanes;
using detail::LeafSprings;

// Lanes without a system of their own repeat the last one.
struct MidpointBatch::Eight {
  Eight(const detail::EdgeRows& rows, int first_system, int system_count)
      : first(first_system), count(system_count), springs(rows), solver(springs) {}

  int system_of(int lane) const { return first + std::min(lane, count - 1); }

  int first, count;
  LeafSprings springs;
  detail::ChebyshevMidpoint<LeafSprings> solver;
  std::array<Points3, LeafLanes::kLeaves> loads;
};

MidpointBatch::MidpointBatch(const std::vector<System*>& systems, const MidpointOptions& options)
    : systems_(systems), options_(options) {
  options.validate();
  if (systems.empty()) return;
  const Stencil& edges = systems[0]->spring_edges();
  for (std::size_t k = 0; k < systems.size(); ++k) {
    const Stencil& own = systems[k]->spring_edges();
    if (systems[k]->vertex_count() != systems[0]->vertex_count() || own.rows() != edges.rows() ||
        own != edges)
      throw Error(ErrorCode::configuration,
                  fmt::format("system {} of the batch has other edges than system 0; step it by itself", k));
    if (!systems[k]->only_springs_and_loads())
      throw Error(ErrorCode::configuration,
                  fmt::format("system {} of the batch has terms that are neither springs nor loads; step it "
                              "by ImplicitMidpoint",
                              k));
  }
  const detail::EdgeRows rows(systems[0]->vertex_count(), edges);
  const int count = static_cast<int>(systems.size());
  for (int first = 0; first < count; first += LeafLanes::kLeaves)
    eights_.push_back(std::make_unique<Eight>(rows, first, std::min(LeafLanes::kLeaves, count - first)));
}

MidpointBatch::~MidpointBatch() = default;

std::vector<StepReport> MidpointBatch::step(std::span<MotionState> states, double dt) {
  detail::require_count("states", static_cast<Eigen::Index>(states.size()),
                        static_cast<Eigen::Index>(systems_.size()));
  for (std::size_t k = 0; k < states.size(); ++k) detail::begin_step(states[k], *systems_[k], dt);
  std::vector<StepReport> reports(states.size());
  parallel_for(static_cast<int>(eights_.size()), 1, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) step_eight(*eights_[e], states, dt, reports);
  });
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!reports[k].converged) reports[k] = ImplicitMidpoint(*systems_[k], options_).step(states[k], dt);
  }
  return reports;
}

void MidpointBatch::step_eight(Eight& eight, std::span<MotionState> states, double dt,
                               std::vector<StepReport>& reports) {
  std::array<const EdgeLaw*, LeafLanes::kLeaves> laws;
  std::array<detail::StepProblem, LeafLanes::kLeaves> problems;
  for (int lane = 0; lane < LeafLanes::kLeaves; ++lane) {
    const int k = eight.system_of(lane);
    laws[lane] = systems_[k]->edge_law();
    systems_[k]->loads(states[k].positions, eight.loads[lane]);
    problems[lane] = {systems_[k], &eight.loads[lane], &states[k]};
  }
  eight.springs.set_laws(laws);
  const auto solved = eight.solver.solve(problems, dt, options_.tolerance);
  for (int lane = 0; lane < eight.count; ++lane) {
    StepReport& report = reports[eight.first + lane];
    report.converged = solved[lane].converged;
    report.dt = dt;
    report.substeps = 1;
    report.linear = solved[lane].passes;
    report.residual = solved[lane].scale > 0.0 ? solved[lane].residual / solved[lane].scale : 0.0;
  }
}

}  // namespace wilt
