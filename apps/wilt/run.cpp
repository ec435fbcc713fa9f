#include "run.hpp"

#include <chrono>

#include "interrupts.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::cli {

WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal,
                    const CheckpointOptions& checkpoint) {
  end_on_interrupt();  // nothing is worth keeping before the first frame
  Checkpoints checkpoints(checkpoint, terminal);
  const Monitor monitor = terminal.monitor();
  WitheredLeaf withered = prepare(request, config, monitor);
  const auto start = std::chrono::steady_clock::now();
  Simulation simulation(withered.leaf, withered.venation, withered.config);
  checkpoints.resume(simulation);
  ask_on_interrupt();
  withered.result =
      simulate(std::move(simulation), monitor, [&](const Simulation& now) { checkpoints.save(now); });
  withered.timings.simulation =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return withered;
}

}  // namespace wilt::cli
