#include "wilt/simulation/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/hash.hpp"
#include "wilt/core/version.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/regions.hpp"
#include "wilt/simulation/watchdog.hpp"

namespace wilt {
namespace {

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

// Whether a setting means nothing to the mechanics.
bool is_of_water(const std::string& key) {
  return key.rfind("water.", 0) == 0 || key.rfind("pressure.", 0) == 0;
}

std::vector<VertexId> tip_vertices(const Venation& venation) {
  std::vector<VertexId> tips;
  for (const Tip& tip : venation.tips) tips.push_back(tip.vertex);
  return tips;
}

}  // namespace

// The model, the state of motion and what is recorded of them.
class Simulation::Run {
 public:
  Run(const Leaf& leaf, const Venation& venation, const Config& config)
      : leaf_(leaf),
        venation_(venation),
        config_(config),
        scale_(kWorkingLength / leaf_length(leaf)),
        rest_(scale_ * leaf.positions),
        regions_(leaf_regions(leaf, venation)),
        metrics_(leaf.mesh, rest_, leaf.petiole, tip_vertices(venation)),
        ring_(leaf.mesh.one_ring(leaf.petiole)),
        frames_(frame_iterations(config)) {
    ring_.push_back(leaf.petiole);
    state_.positions = rest_;
    state_.complete(static_cast<int>(rest_.rows()));
    build(config_);
    record();
  }

  int iteration() const { return iteration_; }
  int last_iteration() const { return static_cast<int>(config_.iterations); }
  bool ended() const { return !result_.completed || iteration_ >= last_iteration(); }
  const Config& config() const { return config_; }
  void change(std::string_view key, std::string_view value) { add_change(config_, iteration_, key, value); }
  const SimulationResult& result() const { return result_; }
  Frame frame() const { return frame_of(in_petiole_frame()); }
  FrameMetrics metrics() const { return metrics_.measure(in_petiole_frame(), iteration_); }
  const MotionState& motion() const { return state_; }
  const DeformationModel& model() const { return *model_; }
  double scale() const { return scale_; }

  void step() {
    const int iteration = iteration_ + 1;
    try {
      take_changes();
      model_->advance(config_.dt, state_.positions);
    } catch (const Error& error) {  // whatever it is called: the settings were good enough for the first step
      return stop(iteration, error.what());
    }
    const StepReport report = integrator_->step(state_, config_.dt);
    result_.steps.push_back(row_of(report, iteration));
    if (!report.converged) return stop(iteration, report.reason);
    iteration_ = iteration;
    record();
    const std::string complaint =
        watchdog_->complaint(result_.steps.back(), metrics_.max_strain(state_.positions), state_.velocities,
                             model_->system().masses());
    if (!complaint.empty()) stop(iteration, complaint);
  }

  Checkpoint checkpoint() {
    WILT_CHECK(result_.completed, iteration_);
    Checkpoint checkpoint{version(), to_json(config_), fingerprint(), iteration_, {}};
    StateArchive archive = StateArchive::saving(checkpoint.arrays);
    exchange(archive);
    return checkpoint;
  }

  void restore(const Checkpoint& checkpoint) {
    require_same_run(checkpoint, to_json(config_), fingerprint());
    if (!config_.changes.empty()) build(config_after(config_, checkpoint.iteration - 1));
    StateArchive archive = StateArchive::restoring(checkpoint.arrays);
    exchange(archive);
    iteration_ = checkpoint.iteration;
    const auto recorded = std::upper_bound(frames_.begin(), frames_.end(), iteration_) - frames_.begin();
    if (iteration_ < 0 || iteration_ > last_iteration() ||
        result_.steps.size() != static_cast<std::size_t>(iteration_) ||
        result_.frames.size() != static_cast<std::size_t>(recorded))
      throw Error(ErrorCode::input, fmt::format("it holds {} steps and {} frames at iteration {}",
                                                result_.steps.size(), result_.frames.size(), iteration_));
  }

  // `result` is what was recorded.
  SimulationResult finish(SimulationResult result) const {
    if (result.frames.back().iteration != iteration_) record_frame(result);
    result.positions_hash = fmt::format("{:016x}", hash_entries(result.frames.back().positions));
    return result;
  }
  SimulationResult take_result() { return std::move(result_); }

 private:
  ModelInput input(const Config& config) const { return {leaf_, venation_, config, scale_, rest_}; }

  // The model as these settings have it, at rest, and what steps and watches it.
  void build(const Config& config) {
    auto model = make_model(input(config));
    integrator_.emplace(model->system(), midpoint_options(config));
    watchdog_.emplace(config.dt, config.solver.tolerance);
    model_ = std::move(model);
    result_.note = note();
  }

  // What the user should know.
  std::string note() const {
    std::string text = model_->note();
    if (config_.changes.empty() || config_.changes.back().iteration < last_iteration()) return text;
    const Change& late = config_.changes.back();
    return fmt::format("{}{}the change of {} after iteration {} never comes: the run has {} iterations", text,
                       text.empty() ? "" : "; ", late.key, late.iteration, last_iteration());
  }

  // Before a step. Settings of the water leave the mechanics as they are, matrices and all. Else: a model is
  // a function of its settings and of the state that it exchanges, so one of the new settings goes on with
  // the state of the old.
  void take_changes() {
    bool due = false, only_water = true;
    for (const Change& change : config_.changes) {
      if (change.iteration != iteration_) continue;
      due = true;
      only_water = only_water && is_of_water(change.key);
    }
    if (!due) return;
    const Config now = config_after(config_, iteration_);
    if (only_water) {
      model_->change_water(input(now));
      result_.note = note();
      return;
    }
    StateArrays state;
    StateArchive left = StateArchive::saving(state), taken = StateArchive::restoring(state);
    model_->exchange_state(left);
    build(now);
    model_->exchange_state(taken);
  }

  StepRow row_of(const StepReport& report, int iteration) const {
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
    return row;
  }

  // What is reported of every iteration, and a frame where one is due.
  void record() {
    const auto rows = force_rows(regions_, *model_, state_.positions, state_.velocities, iteration_);
    result_.forces.insert(result_.forces.end(), rows.begin(), rows.end());
    if (std::binary_search(frames_.begin(), frames_.end(), iteration_)) record_frame(result_);
  }

  void record_frame(SimulationResult& result) const {
    const Points3 held = in_petiole_frame();
    result.frames.push_back(frame_of(held));
    result.metrics.push_back(metrics_.measure(held, iteration_));
  }

  // `held` as in_petiole_frame() has it.
  Frame frame_of(const Points3& held) const {
    const DeformationModel::Hanging hanging = model_->hanging();
    Frame frame;
    frame.iteration = iteration_;
    frame.positions =
        ((held * hanging.rotation.transpose()).rowwise() + hanging.translation.transpose()) / scale_;
    frame.stalk = hanging.stalk / scale_;
    frame.water_fraction = model_->water().cwiseQuotient(model_->water() + model_->dry_mass());
    frame.dryness = model_->dryness();
    return frame;
  }

  void stop(int iteration, const std::string& reason) {
    result_.completed = false;
    result_.stop_reason = fmt::format("iteration {}: {}", iteration, reason);
  }

  // All that changes in a run and that the next iteration, or the result, depends on.
  void exchange(StateArchive& archive) {
    archive.matrix("motion.positions", state_.positions);
    archive.matrix("motion.velocities", state_.velocities);
    archive.matrix("motion.accelerations", state_.accelerations);
    archive.matrix("motion.jerks", state_.jerks);
    model_->exchange_state(archive);
    exchange_result(archive, result_);
  }

  // Made for the first checkpoint: a pass over the leaf and the distances from all of its tips.
  const std::string& fingerprint() {
    if (fingerprint_.empty()) fingerprint_ = run_fingerprint(leaf_, venation_);
    return fingerprint_;
  }

  // A free leaf's rigid motion is taken out: its petiole's one-ring is laid back on its rest place.
  Points3 in_petiole_frame() const {
    if (config_.pin != "free") return state_.positions;
    const Eigen::Matrix3d turn = best_rotation(rest_, state_.positions, ring_);
    const auto origin = state_.positions.row(leaf_.petiole);
    return ((state_.positions.rowwise() - origin) * turn).rowwise() + rest_.row(leaf_.petiole);
  }

  const Leaf& leaf_;
  const Venation& venation_;
  Config config_;
  double scale_;  // working units per metre
  Points3 rest_;
  std::unique_ptr<DeformationModel> model_;  // of the settings of the last step
  VertexData<Region> regions_;
  LeafMetrics metrics_;
  std::vector<VertexId> ring_;
  std::optional<ImplicitMidpoint> integrator_;
  std::optional<Watchdog> watchdog_;
  std::vector<int> frames_;  // the iterations at which frames are taken, ascending
  MotionState state_;
  int iteration_ = 0;
  SimulationResult result_;
  std::string fingerprint_;  // empty until it is asked for
};

Simulation::Simulation(const Leaf& leaf, const Venation& venation, const Config& config)
    : run_(std::make_unique<Run>(leaf, venation, config)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

int Simulation::iteration() const {
  return run_->iteration();
}

int Simulation::last_iteration() const {
  return run_->last_iteration();
}

bool Simulation::ended() const {
  return run_->ended();
}

const Config& Simulation::config() const {
  return run_->config();
}

void Simulation::change(std::string_view key, std::string_view value) {
  run_->change(key, value);
}

void Simulation::step() {
  if (!ended()) run_->step();
}

const SimulationResult& Simulation::result() const {
  return run_->result();
}

Checkpoint Simulation::checkpoint() const {
  return run_->checkpoint();
}

void Simulation::restore(const Checkpoint& checkpoint) {
  run_->restore(checkpoint);
}

Frame Simulation::frame() const {
  return run_->frame();
}

FrameMetrics Simulation::metrics() const {
  return run_->metrics();
}

const MotionState& Simulation::motion() const {
  return run_->motion();
}

const DeformationModel& Simulation::model() const {
  return run_->model();
}

double Simulation::scale() const {
  return run_->scale();
}

SimulationResult Simulation::finish() && {
  return run_->finish(run_->take_result());
}

SimulationResult Simulation::finish() const& {
  return run_->finish(run_->result());
}

SimulationResult simulate(Simulation simulation, const Monitor& monitor,
                          const std::function<void(const Simulation&)>& after) {
  const int last = simulation.last_iteration();
  if (!simulation.result().note.empty()) monitor.say(simulation.result().note);
  bool interrupted = false;
  while (!simulation.ended()) {
    monitor.report("withering", static_cast<double>(simulation.iteration()) / last);
    interrupted = monitor.stop_requested();
    if (interrupted) {
      if (after) after(simulation);
      break;
    }
    simulation.step();
    if (after && simulation.result().completed) after(simulation);
  }
  monitor.report("withering", 1.0);
  const int done = simulation.iteration();
  SimulationResult result = std::move(simulation).finish();
  if (interrupted) {
    result.completed = false;
    result.interrupted = true;
    result.stop_reason = fmt::format("interrupted after iteration {} of {}", done, last);
  }
  return result;
}

SimulationResult simulate(const Leaf& leaf, const Venation& venation, const Config& config,
                          const Monitor& monitor) {
  return simulate(Simulation(leaf, venation, config), monitor);
}

}  // namespace wilt
