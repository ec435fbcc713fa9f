// What a simulation leaves behind: frames, metrics, a row per step and per region.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// The leaf at one iteration. Metres, leaf frame (leaf.hpp), the droop of the petiole included.
struct Frame {
  int iteration = 0;               ///< 0: at rest
  Points3 positions;               ///< #V x 3, metres
  Points3 stalk;                   ///< #K x 3, metres, the stalk's centreline
  Eigen::VectorXd water_fraction;  ///< #V, w / m
  Eigen::VectorXd dryness;         ///< #V, 0 (fresh) to 1 (dry): (w_0 - w) / (d w_0), clipped
};

/// Section 7 of docs/method.md; taken at every frame.
struct FrameMetrics {
  int iteration = 0;
  double wrinkle = 0.0;               ///< RMS over interior vertices, in units of the leaf's length
  double curl = 0.0;                  ///< radians, mean over the tips
  double area_ratio = 1.0;            ///< the blade's area over its area at rest
  double projected_area_ratio = 1.0;  ///< the same of the area seen along the rest blade's mean normal
  double max_strain = 0.0;            ///< largest |l / l_rest - 1| of any edge
  int self_intersections = 0;         ///< pairs of triangles that intersect
};

/// One time step as it went.
struct StepRow {
  int iteration = 0;
  double dt = 0.0;        ///< the step that was taken (the smallest one after halving)
  int newton = 0;         ///< Newton iterations
  int linear = 0;         ///< conjugate-gradient iterations
  double residual = 0.0;  ///< of the midpoint equation, relative to the step's force scale
  bool converged = true;
  double kinetic = 0.0, elastic = 0.0, bending = 0.0;  ///< energies, working units
  double water = 0.0;                                  ///< total, working units
};

enum class Region { tip, vein, margin, mesophyll };
const char* region_name(Region region);

/// Mean magnitude of each force over the vertices of a region (working units).
struct ForceRow {
  int iteration = 0;
  Region region = Region::tip;
  double elastic = 0.0, damping = 0.0, swelling = 0.0, external = 0.0;
  double water = 0.0;     ///< mean w / m
  double pressure = 0.0;  ///< mean p - p_out
};

struct SimulationResult {
  std::vector<Frame> frames;          ///< the first is the leaf at rest
  std::vector<FrameMetrics> metrics;  ///< one per frame
  std::vector<StepRow> steps;
  std::vector<ForceRow> forces;
  bool completed = true;       ///< false: stopped early; `stop_reason` says why, what was computed is kept
  bool interrupted = false;    ///< the user asked to stop
  std::string stop_reason;     ///< empty: completed
  std::string note;            ///< what the model did otherwise than its name says; empty: nothing
  std::string positions_hash;  ///< FNV-1a over the last frame's positions, 16 hexadecimal digits
};

}  // namespace wilt
