// --model cell: the paper's model made resolution-independent and conservative, with bending, differential
// strain, stiff veins, a strain limit, gravity and a drooping petiole (docs/method.md, section 6).
#pragma once

#include <vector>

#include "wilt/mechanics/edge_energies.hpp"
#include "wilt/mechanics/hinges.hpp"
#include "wilt/mechanics/nodal_terms.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/external_force.hpp"
#include "wilt/simulation/leaf_water.hpp"
#include "wilt/simulation/petiole_droop.hpp"

namespace wilt {

/// All internal forces are energies but the damping, so net internal force and torque are zero to round-off.
class CellModel : public DeformationModel {
 public:
  explicit CellModel(const ModelInput& input);

  void advance(double dt, const Points3& x) override;
  void change_water(const ModelInput& input) override;
  System& system() override { return system_; }
  void exchange_state(StateArchive& archive) override;
  ForceBreakdown forces(const Points3& x, const Points3& v) const override;
  const Eigen::VectorXd& water() const override { return water_.water(); }
  const Eigen::VectorXd& dry_mass() const override { return water_.dry_mass(); }
  Eigen::VectorXd pressure_drop() const override { return water_.pressure_drop(); }
  Eigen::VectorXd dryness() const override { return water_.dryness(); }
  Points3 tip_forces() const override { return external_.tip_forces() / resolution_; }
  Hanging hanging() const override { return droop_.hanging(); }

 private:
  void add_terms(const ModelInput& input, const Eigen::VectorXd& lengths);
  void update_swelling();
  void update_bending();

  Edges edges_;
  double resolution_;  // n_ref / n: what masses and forces are scaled by
  LeafWater water_;
  ExternalForce external_;
  System system_;
  PetioleDroop droop_;
  Eigen::VectorXd swelling_area_;    // #E, k_p alpha_ij
  Eigen::VectorXd swelling_weight_;  // #V, eta
  Eigen::VectorXd fold_weight_;      // #E, what folding adds to eta along an edge
  Stencil hinges_;
  Eigen::VectorXd fresh_bending_;  // #H, k_b at full turgor
  Eigen::VectorXd fresh_angles_;   // #H, rest angles of the fresh blade
  Eigen::VectorXd drying_angles_;  // #H, what full dryness adds to them
  double bending_turgor_loss_;
  LineTension* swelling_ = nullptr;
  Hinges* bending_ = nullptr;
  Gravity* gravity_ = nullptr;
  NodalForce* external_force_ = nullptr;
};

}  // namespace wilt
