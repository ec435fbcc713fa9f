#include "checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "interrupts.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"

namespace wilt::cli {
namespace {

using Seconds = std::chrono::duration<double>;

}  // namespace

Checkpoints::Checkpoints(CheckpointOptions options, Terminal& terminal)
    : options_(std::move(options)), terminal_(terminal), due_(Clock::now()) {
  if (options_.file.empty()) {
    if (options_.resume)
      throw Error(ErrorCode::configuration,
                  "--resume goes on from a checkpoint; name it with --checkpoint FILE");
    return;
  }
  if (!options_.resume && std::filesystem::exists(options_.file))
    throw Error(
        ErrorCode::configuration,
        fmt::format("--checkpoint '{}' exists; add --resume to go on from it, or delete it to begin anew",
                    options_.file));
}

void Checkpoints::resume(Simulation& simulation) {
  if (!options_.resume) return;
  if (!std::filesystem::exists(options_.file)) {
    terminal_.say(fmt::format("no checkpoint '{}' yet; beginning with the fresh leaf", options_.file));
    return;
  }
  const Checkpoint checkpoint = parse_checkpoint(read_file(options_.file), options_.file);
  try {
    simulation.restore(checkpoint);
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("'{}' cannot be resumed from: {}; give the command that wrote it, or "
                            "delete it to begin anew",
                            options_.file, error.what()));
  }
  terminal_.say(
      fmt::format("resumed after iteration {} of {}", simulation.iteration(), simulation.last_iteration()));
}

void Checkpoints::save(const Simulation& simulation) {
  if (options_.file.empty() || (Clock::now() < due_ && !simulation.ended() && !interrupted())) return;
  const Clock::time_point start = Clock::now();
  try {
    write_file(options_.file, checkpoint_bytes(simulation.checkpoint()));
  } catch (const Error& error) {
    if (!std::exchange(warned_, true)) terminal_.warn(fmt::format("no checkpoint: {}", error.what()));
  }
  const Seconds taken = Clock::now() - start, pause(options_.every);
  due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            options_.every > 0.0 ? std::max(pause, 9.0 * taken) : pause);
}

}  // namespace wilt::cli
