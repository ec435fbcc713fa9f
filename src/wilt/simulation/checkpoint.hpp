// A run half done, as a file: what it takes to go on as if it had never stopped.
#pragma once

#include <string>
#include <string_view>

#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/simulation/state_archive.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// A run after `iteration` steps.
struct Checkpoint {
  std::string version;  ///< of the wilt that ran it
  std::string config;   ///< to_json() of the resolved configuration
  std::string leaf;     ///< fingerprint of the leaf and its veins, 16 hexadecimal digits
  int iteration = 0;    ///< the last one done
  StateArrays arrays;   ///< motion, model and results so far
};

/// The bytes of a checkpoint file: the line "wilt checkpoint 1"; a line of JSON {"version", "config", "leaf",
/// "iteration", "arrays": [{"name", "rows", "columns"}, ...]}; the arrays' numbers one after the other,
/// column by column, as 64-bit floats of this machine's byte order; the FNV-1a hash of all that as 16
/// hexadecimal digits and a line feed.
std::string checkpoint_bytes(const Checkpoint& checkpoint);

/// Reads them back; `name` is the file's in messages. Throws Error{input} for what is no checkpoint, was cut
/// off or changed, or holds a number that is not finite.
Checkpoint parse_checkpoint(std::string_view bytes, const std::string& name);

/// The fingerprint of what a run is given: faces, positions, petiole and stalk, tips and veins and the
/// distances from them.
std::string run_fingerprint(const Leaf& leaf, const Venation& venation);

/// Throws Error{input} unless `checkpoint` is of a run with this configuration (to_json) on this leaf by this
/// version; names what differs.
void require_same_run(const Checkpoint& checkpoint, const std::string& config, const std::string& leaf);

/// Frames, metrics, steps and forces. Restoring wants a result that holds the frame at rest.
void exchange_result(StateArchive& archive, SimulationResult& result);

}  // namespace wilt
