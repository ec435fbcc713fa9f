// The water of a leaf's cells over time: mass, loss to the air, permeation, pressure.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/state_archive.hpp"
#include "wilt/water/permeation.hpp"
#include "wilt/water/pressure.hpp"

namespace wilt {

/// As printed, or in the forms that conserve water and converge with the step (docs/method.md, section 5).
/// The printed permeation is explicit in all but name and cannot step fine meshes (maple: above 35,000
/// vertices, willow: above 4,000): there the conservative one stands in for it.
enum class WaterForm { printed, conservative };

class LeafWater {
 public:
  /// `mass` #V, m at the start; `loss` #V per time unit; `scale` is what the masses were scaled by.
  LeafWater(const Config& config, WaterForm form, const Eigen::VectorXd& mass, const Eigen::VectorXd& loss,
            double scale, const Edges& edges, const Eigen::VectorXd& rest_lengths);

  /// Has other settings water.* and pressure.* from here on, and another loss.
  void change(const Config& config, const Eigen::VectorXd& loss);

  /// No cell falls below 1e-3 times `scale`, or a tenth of the driest cell's first water where that is less.
  /// Throws Error{simulation} when a mass is not finite, and, in the conservative form, when the solver stops
  /// short or water is not what it was less what was lost, to 1e-9: the state is then not to be used.
  void advance(double dt);
  void exchange_state(StateArchive& archive);

  bool printed_permeation() const { return printed_permeation_; }

  const Eigen::VectorXd& water() const { return water_; }       ///< #V, w
  const Eigen::VectorXd& dry_mass() const { return dry_; }      ///< #V, b
  Eigen::VectorXd mass() const { return water_ + dry_; }        ///< #V, m
  Eigen::VectorXd pressure_drop() const { return -pressure_; }  ///< #V, dp = p_out - p
  Eigen::VectorXd dryness() const;                              ///< #V, 0 to 1

 private:
  WaterForm form_;
  PressureOptions pressure_options_;
  double dryness_scale_;
  Permeation permeation_;
  Eigen::VectorXd dry_, water_, first_water_, loss_, pressure_;  // pressure is p - p_out
  bool printed_permeation_ = false;
};

}  // namespace wilt
