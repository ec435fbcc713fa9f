// A leaf withers: model, stepper, frames and metrics together.
#pragma once

#include "wilt/core/monitor.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt {

/// S: the length of a leaf in working units, petiole to the farthest vertex.
inline constexpr double kWorkingLength = 8.0;

/// Runs `config.iterations` steps. A step that does not converge is halved; when that fails too, or the state
/// is no longer finite, the run stops, keeps what was computed and says why (SimulationResult::stop_reason).
/// Cancellation by the monitor keeps what was computed as well. Deterministic on any number of threads.
SimulationResult simulate(const Leaf& leaf, const Venation& venation, const Config& config,
                          const Monitor& monitor = {});

}  // namespace wilt
