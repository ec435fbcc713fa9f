// A leaf withers: model, stepper, frames and metrics together.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "wilt/core/monitor.hpp"
#include "wilt/simulation/checkpoint.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

/// S: the length of a leaf in working units, petiole to the farthest vertex.
inline constexpr double kWorkingLength = 8.0;

/// A run, step by step. Deterministic on any number of threads.
class Simulation {
 public:
  /// At the leaf at rest, iteration 0. The leaf and the veins must outlive it. Throws Error{configuration}.
  Simulation(const Leaf& leaf, const Venation& venation, const Config& config);
  Simulation(Simulation&&) noexcept;
  ~Simulation();

  int iteration() const;       ///< the last one done
  int last_iteration() const;  ///< `config.iterations`
  /// The run's, with all changes.
  const Config& config() const;
  /// All iterations are done, or the run has stopped: SimulationResult::stop_reason.
  bool ended() const;

  /// One iteration. A step that does not converge is halved; when that fails too, or the watchdog
  /// (watchdog.hpp) finds that no leaf does that, the run stops, keeps what was computed and says why.
  /// Nothing happens once it has ended.
  void step();

  /// Has a setting change now: the next steps have the new value, and config() says so. Costs little: what
  /// follows from settings is made anew in the next step, once for all changes. Throws Error{configuration}
  /// as add_change() does; nothing has changed then.
  void change(std::string_view key, std::string_view value);

  /// What has been recorded until now.
  const SimulationResult& result() const;

  /// The leaf as it is now, as a frame would record it.
  Frame frame() const;
  /// The metrics of frame().
  FrameMetrics metrics() const;
  /// Positions, velocities and so on, #V x 3 each, working units (kWorkingLength), per time unit of
  /// `config.dt`; where the petiole holds the blade before it droops. The next step changes what is referred
  /// to, and may put it elsewhere.
  const MotionState& motion() const;
  /// Water, masses, pressure, dryness and the forces at motion(); working units. The same holds.
  const DeformationModel& model() const;
  double scale() const;  ///< working units per metre

  /// What the run must remember to go on from here. Not of one that has stopped.
  Checkpoint checkpoint() const;
  /// Goes on from there: every number of the result will be as if the run had never been left. Throws
  /// Error{input} when the checkpoint is of another leaf, other veins, another configuration or version; the
  /// simulation may then be at no iteration at all.
  void restore(const Checkpoint& checkpoint);

  /// Ends the run here: the result, with a frame of the last iteration.
  SimulationResult finish() &&;
  /// The same of a run that may go on: its first frames, steps and so on are result()'s.
  SimulationResult finish() const&;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

/// Runs `simulation` until it has ended. Cancellation by the monitor keeps what was computed. `after`, if
/// given, sees the simulation after every iteration, and once more when it was cancelled.
SimulationResult simulate(Simulation simulation, const Monitor& monitor = {},
                          const std::function<void(const Simulation&)>& after = {});

/// The same from the leaf at rest.
SimulationResult simulate(const Leaf& leaf, const Venation& venation, const Config& config,
                          const Monitor& monitor = {});

}  // namespace wilt
