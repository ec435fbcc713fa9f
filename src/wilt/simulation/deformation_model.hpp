// What a model of withering is to the stepper: physiology that changes forces, and a mechanical system.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/mechanics/system.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/state_archive.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// The force on every vertex, by kind, #V x 3 each, working units.
struct ForceBreakdown {
  Points3 elastic, damping, swelling, external;
};

struct ModelInput;

/// One way for a leaf to wither. The stepper calls `advance` and then steps `system` by the same dt; whatever
/// a model needs (more layers, other energies, driven veins) stays behind this interface.
class DeformationModel {
 public:
  virtual ~DeformationModel() = default;

  /// Moves water and pressure from iteration n to n+1 and sets masses and forces for the step between, which
  /// starts at positions `x` (#V x 3).
  virtual void advance(double dt, const Points3& x) = 0;

  /// Has other settings water.* and pressure.* from here on; all else of `input` is what this was made from.
  virtual void change_water(const ModelInput& input) = 0;

  virtual System& system() = 0;

  /// Saves or restores what `advance` changes and depends on; the system's terms follow from it with the next
  /// `advance`.
  virtual void exchange_state(StateArchive& archive) = 0;

  /// What the model does otherwise than its name says, on this leaf; empty: nothing.
  virtual std::string note() const { return {}; }

  /// The forces at a state (#V x 3 each), for reports.
  virtual ForceBreakdown forces(const Points3& x, const Points3& v) const = 0;

  virtual const Eigen::VectorXd& water() const = 0;     ///< #V, w
  virtual const Eigen::VectorXd& dry_mass() const = 0;  ///< #V, b
  virtual Eigen::VectorXd pressure_drop() const = 0;    ///< #V, dp = p_out - p
  virtual Eigen::VectorXd dryness() const = 0;          ///< #V, 0 to 1
  virtual Points3 tip_forces() const = 0;  ///< #tips x 3, the external force at each tip, in Table 2's unit

  /// How the petiole carries the blade now: applied to every position in the petiole's frame; the stalk's
  /// centreline after bending (#K x 3, working units; empty without a stalk).
  struct Hanging {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Vec3 translation = Vec3::Zero();
    Points3 stalk;
  };
  virtual Hanging hanging() const = 0;
};

/// What every model starts from, in working units (leaf length 8).
struct ModelInput {
  const Leaf& leaf;
  const Venation& venation;
  const Config& config;
  double scale;  ///< working units per metre
  Points3 rest;  ///< #V x 3, working units
};

/// "paper", "cell": the words that --model takes.
const std::vector<std::string>& model_names();

/// Throws Error{configuration} for an unknown name.
std::unique_ptr<DeformationModel> make_model(const ModelInput& input);

}  // namespace wilt
