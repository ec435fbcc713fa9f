// A run with random settings and what can be said of it, judged without the program's own watchdog.
#pragma once

#include <string>

#include "random_settings/draw.hpp"

namespace wilt::random_settings {

struct Outcome {
  /// "good": all steps converged and nothing is amiss; "refused": before the run, by a word about the
  /// settings; "stopped": the run ended early, with a reason; "bad": none of these, and `reason` says what is
  /// amiss.
  std::string kind;
  std::string reason;
  int steps = 0;
  double residual = 0.0;   ///< the largest of a step, over solver.tolerance
  double imbalance = 0.0;  ///< water that came from nowhere or left unasked in a step, of the leaf's water
  double strain = 0.0;     ///< the largest |l / l_rest - 1| of a frame
  double motion = 0.0;     ///< the largest of a step: root mean square velocity x dt, in leaf lengths
  double energy = 0.0;     ///< the largest elastic and bending energy of a step, working units
  int halved = 0;          ///< steps that were
};

/// Makes the leaf, runs it and writes its GLB into memory.
Outcome run(const Draw& draw);

}  // namespace wilt::random_settings
