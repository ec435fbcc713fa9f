// The time-varying external forces at the vein tips (paper, section 4.4).
//
//   fout_r^{n+1} = fout_r^n + k_r dt,   k_r = kappa fout_r^0
//   Fo_i = sum_r fout_r^{n+1} exp(-K_r gd_ir)
#pragma once

#include <Eigen/Core>
#include <string>

#include "wilt/core/types.hpp"
#include "wilt/simulation/state_archive.hpp"

namespace wilt {

/// Table 2 of the paper, #tips x 3: the first force at each tip, in the order r1, r2, ... Variant "a" to "f"
/// where there are seven tips, else (0, 0, 0.04) at each.
Points3 initial_tip_forces(int tips, const std::string& variant);

class ExternalForce {
 public:
  /// `initial` #tips x 3; `tip_distance` #tips x #V in working units; `range` is K_r (1 / working unit),
  /// `growth` kappa (1 / time unit).
  ExternalForce(const Points3& initial, const Eigen::MatrixXd& tip_distance, double range, double growth);

  void advance(double dt) { tip_forces_ += dt * rate_; }
  void exchange_state(StateArchive& archive) { archive.matrix("external.tip_forces", tip_forces_); }
  const Points3& tip_forces() const { return tip_forces_; }     ///< fout_r now, #tips x 3
  Points3 on_vertices() const { return reach_ * tip_forces_; }  ///< Fo_i, #V x 3

 private:
  Points3 tip_forces_, rate_;
  Eigen::MatrixXd reach_;  // #V x #tips: exp(-K_r gd_ir)
};

}  // namespace wilt
