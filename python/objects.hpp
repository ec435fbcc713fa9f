// What Python's objects hold. They never change once made, but for RunObject (run_object.hpp).
#pragma once

#include <memory>
#include <optional>

#include "wilt/leaf/leaf.hpp"
#include "wilt/output/report.hpp"
#include "wilt/run/withered_leaf.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt::python {

struct LeafObject {
  Leaf leaf;
  std::optional<int> vertices;  ///< that were asked for
  double seconds = 0.0;         ///< that it took
};

struct VeinsObject {
  std::shared_ptr<const LeafObject> leaf;
  Venation venation;
  Config config;  ///< whose `veins` they were found with
};

/// A leaf that is withered: what frames are of.
struct Subject {
  std::shared_ptr<const LeafObject> leaf;
  std::shared_ptr<const VeinsObject> veins;
  Config config;
};

struct FrameObject {
  std::shared_ptr<const Subject> subject;
  std::shared_ptr<const Frame> frame;
  FrameMetrics metrics;
};

/// The simulation as it was after an iteration: its frame, and what moves it, in working units (the leaf is 8
/// long) and in the frame in which the petiole holds the blade before it droops.
struct StateObject : FrameObject {
  Points3 working_positions;  ///< #V x 3, working lengths
  Points3 velocities;         ///< #V x 3, working lengths per time unit (`dt` is in time units)
  Eigen::VectorXd water;      ///< #V, w, working masses
  Eigen::VectorXd dry_mass;   ///< #V, b, working masses
  Eigen::VectorXd mass;       ///< #V, m = w + b, working masses
  Eigen::VectorXd pressure;   ///< #V, p - p_out, working units: below 0 as water goes
  /// {kind: #V x 3}, working units; kinds: "elastic" (with the limits of strain), "damping", "swelling",
  /// "external".
  ForceBreakdown forces;
};

struct ResultObject {
  std::shared_ptr<const Subject> subject;
  std::shared_ptr<const WitheredLeaf> withered;
};

}  // namespace wilt::python
