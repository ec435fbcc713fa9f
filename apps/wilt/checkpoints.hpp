// --checkpoint and --resume: a run that may be killed at any moment loses little.
#pragma once

#include <chrono>
#include <string>

#include "terminal.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::cli {

struct CheckpointOptions {
  std::string file;     ///< empty: none is written
  double every = 10.0;  ///< seconds between two, >= 0; a checkpoint takes at most a tenth of the time if > 0
  bool resume = false;  ///< go on from the file; from the beginning where there is none yet
};

/// Writes a run's checkpoints, each whole or not at all, and reads the last one back.
class Checkpoints {
 public:
  /// Throws before any work: Error{configuration} for options that do not go together, and for a file that
  /// would be lost. The terminal must outlive it.
  Checkpoints(CheckpointOptions options, Terminal& terminal);

  /// Puts the simulation where the file left it, if that was asked for. Throws Error{input}, naming the file.
  void resume(Simulation& simulation);

  /// After an iteration: writes a checkpoint when one is due, the run has ended or the user asked to stop.
  /// What cannot be written is said once; the run goes on.
  void save(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;

  CheckpointOptions options_;
  Terminal& terminal_;
  Clock::time_point due_;
  bool warned_ = false;
};

}  // namespace wilt::cli
