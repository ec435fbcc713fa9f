// --model paper: the printed equations, with the repairs of docs/method.md.
#pragma once

#include "wilt/mechanics/edge_forces.hpp"
#include "wilt/mechanics/nodal_terms.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/external_force.hpp"
#include "wilt/simulation/leaf_water.hpp"

namespace wilt {

/// Springs, damping, one-sided swelling and external forces on a mesh of cells. Every total scales with the
/// number of vertices, as printed; the net internal force of the swelling is not zero.
class PaperModel : public DeformationModel {
 public:
  explicit PaperModel(const ModelInput& input);

  void advance(double dt, const Points3& x) override;
  void change_water(const ModelInput& input) override;
  System& system() override { return system_; }
  void exchange_state(StateArchive& archive) override;
  std::string note() const override;
  ForceBreakdown forces(const Points3& x, const Points3& v) const override;
  const Eigen::VectorXd& water() const override { return water_.water(); }
  const Eigen::VectorXd& dry_mass() const override { return water_.dry_mass(); }
  Eigen::VectorXd pressure_drop() const override { return water_.pressure_drop(); }
  Eigen::VectorXd dryness() const override { return water_.dryness(); }
  Points3 tip_forces() const override { return external_.tip_forces(); }
  Hanging hanging() const override;

 private:
  const SurfaceMesh& mesh_;
  double swelling_;  // k_p
  Points3 stalk_;    // working units
  LeafWater water_;
  ExternalForce external_;
  System system_;
  OneSidedSwelling* swelling_force_;
  NodalForce* external_force_;
};

}  // namespace wilt
