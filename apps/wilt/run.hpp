// A whole run at the terminal: leaf, veins, simulation, with Ctrl-C and checkpoints.
#pragma once

#include "checkpoints.hpp"
#include "terminal.hpp"
#include "wilt/run/withered_leaf.hpp"

namespace wilt::cli {

/// Loads the leaf, finds its veins and withers it. The leaf's notes go to the terminal. Throws before any
/// work where the checkpoint's options are wrong (checkpoints.hpp).
WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal,
                    const CheckpointOptions& checkpoint = {});

}  // namespace wilt::cli
