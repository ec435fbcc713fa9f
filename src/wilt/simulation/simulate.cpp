#include "wilt/simulation/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/regions.hpp"

namespace wilt {
namespace {

// FNV-1a over the bytes of the positions.
std::string hash_of(const Points3& positions) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto* bytes = reinterpret_cast<const unsigned char*>(positions.data());
  for (std::size_t i = 0; i < sizeof(double) * static_cast<std::size_t>(positions.size()); ++i) {
    hash ^= bytes[i];
    hash *= 1099511628211ULL;
  }
  return fmt::format("{:016x}", hash);
}

// The iterations at which frames are taken: the first, the last, evenly between.
std::vector<int> frame_iterations(const Config& config) {
  const int last = static_cast<int>(config.iterations);
  const int count = std::min(static_cast<int>(config.frames), last + 1);
  std::vector<int> iterations;
  for (int k = 0; k < count; ++k)
    iterations.push_back(count == 1 ? 0
                                    : static_cast<int>((static_cast<std::int64_t>(k) * last) / (count - 1)));
  return iterations;
}

MidpointOptions midpoint_options(const Config& config) {
  MidpointOptions options;
  options.tolerance = config.solver.tolerance;
  options.max_newton = static_cast<int>(config.solver.max_newton);
  options.max_halvings = static_cast<int>(config.solver.max_halvings);
  return options;
}

// One run: the model, the state of motion and what is recorded of them.
class Run {
 public:
  Run(const Leaf& leaf, const Venation& venation, const Config& config)
      : leaf_(leaf),
        scale_(kWorkingLength / leaf_length(leaf)),
        rest_(scale_ * leaf.positions),
        free_(config.pin == "free"),
        model_(make_model({leaf, venation, config, scale_, rest_})),
        regions_(leaf_regions(leaf, venation)),
        metrics_(leaf.mesh, rest_, leaf.petiole, tip_vertices(venation)),
        ring_(leaf.mesh.one_ring(leaf.petiole)),
        integrator_(model_->system(), midpoint_options(config)),
        dt_(config.dt) {
    ring_.push_back(leaf.petiole);
    state_.positions = rest_;
    state_.velocities = Points3::Zero(rest_.rows(), 3);
  }

  std::string note() const { return model_->note(); }

  /// Returns false, with the reason in the result, when the step could not be taken.
  bool step(int iteration, SimulationResult& result) {
    try {
      model_->advance(dt_, state_.positions);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::simulation) throw;
      return stop(iteration, error.what(), result);
    }
    const StepReport report = integrator_.step(state_, dt_);
    const System& system = model_->system();
    StepRow row{iteration,
                report.dt,
                report.newton,
                report.linear,
                report.residual,
                report.converged,
                system.kinetic_energy(state_.velocities)};
    for (const auto& [name, energy] : system.energies(state_.positions)) {
      if (name == "elastic") row.elastic = energy;
      if (name == "bending") row.bending = energy;
    }
    row.water = model_->water().sum();
    result.steps.push_back(row);
    return report.converged || stop(iteration, report.reason, result);
  }

  void record_forces(int iteration, SimulationResult& result) const {
    const auto rows = force_rows(regions_, *model_, state_.positions, state_.velocities, iteration);
    result.forces.insert(result.forces.end(), rows.begin(), rows.end());
  }

  void record_frame(int iteration, SimulationResult& result) const {
    const Points3 held = in_petiole_frame();
    const DeformationModel::Hanging hanging = model_->hanging();
    Frame frame;
    frame.iteration = iteration;
    frame.positions =
        ((held * hanging.rotation.transpose()).rowwise() + hanging.translation.transpose()) / scale_;
    frame.stalk = hanging.stalk / scale_;
    frame.water_fraction = model_->water().cwiseQuotient(model_->water() + model_->dry_mass());
    frame.dryness = model_->dryness();
    result.frames.push_back(std::move(frame));
    result.metrics.push_back(metrics_.measure(held, iteration));
  }

 private:
  static bool stop(int iteration, const std::string& reason, SimulationResult& result) {
    result.completed = false;
    result.stop_reason = fmt::format("iteration {}: {}", iteration, reason);
    return false;
  }

  static std::vector<VertexId> tip_vertices(const Venation& venation) {
    std::vector<VertexId> tips;
    for (const Tip& tip : venation.tips) tips.push_back(tip.vertex);
    return tips;
  }

  // A free leaf's rigid motion is taken out: its petiole's one-ring is laid back on its rest place.
  Points3 in_petiole_frame() const {
    if (!free_) return state_.positions;
    const Eigen::Matrix3d turn = best_rotation(rest_, state_.positions, ring_);
    const auto origin = state_.positions.row(leaf_.petiole);
    return ((state_.positions.rowwise() - origin) * turn).rowwise() + rest_.row(leaf_.petiole);
  }

  const Leaf& leaf_;
  double scale_;  // working units per metre
  Points3 rest_;
  bool free_;
  std::unique_ptr<DeformationModel> model_;
  VertexData<Region> regions_;
  LeafMetrics metrics_;
  std::vector<VertexId> ring_;
  ImplicitMidpoint integrator_;
  double dt_;
  MotionState state_;
};

}  // namespace

SimulationResult simulate(const Leaf& leaf, const Venation& venation, const Config& config,
                          const Monitor& monitor) {
  SimulationResult result;
  Run run(leaf, venation, config);
  result.note = run.note();
  if (!result.note.empty()) monitor.say(result.note);
  const std::vector<int> frames = frame_iterations(config);
  std::size_t next_frame = 0;
  const int last = static_cast<int>(config.iterations);
  int done = 0;  // iterations behind us
  for (int iteration = 0; iteration <= last; ++iteration) {
    if (iteration > 0 && !run.step(iteration, result)) break;
    done = iteration;
    run.record_forces(iteration, result);
    if (next_frame < frames.size() && frames[next_frame] == iteration) {
      run.record_frame(iteration, result);
      ++next_frame;
    }
    monitor.report("withering", last == 0 ? 1.0 : static_cast<double>(iteration) / last);
    if (monitor.stop_requested() && iteration < last) {
      result.completed = false;
      result.interrupted = true;
      result.stop_reason = fmt::format("interrupted after iteration {} of {}", iteration, last);
      break;
    }
  }
  if (result.frames.back().iteration != done) run.record_frame(done, result);
  result.positions_hash = hash_of(result.frames.back().positions);
  return result;
}

}  // namespace wilt
