// How the petiole bends under the blade as its stiffness goes with the turgor.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "wilt/mechanics/petiole_rod.hpp"
#include "wilt/simulation/deformation_model.hpp"

namespace wilt {

/// The stalk as an elastic rod clamped at the stem, in equilibrium at every step. The drawn shape is the
/// balance of the fresh leaf. A leaf without a stalk hangs on an undrawn straight one.
///
/// The blade is stepped in the frame of the rod's end: `gravity` is turned into it, `hanging` turns the
/// result back. That frame turns so slowly that the inertial forces of its turning are left out.
class PetioleDroop {
 public:
  PetioleDroop(const ModelInput& input, const Eigen::VectorXd& mass);

  /// `mass` #V; `turgor` 1 fresh to 0 dry; `x` #V x 3 in the petiole's frame.
  void advance(const Eigen::VectorXd& mass, double turgor, const Points3& x);

  void exchange_state(StateArchive& archive);

  Vec3 gravity() const { return rotation_.transpose() * gravity_; }  ///< in the petiole's frame
  DeformationModel::Hanging hanging() const;

 private:
  RodLoads loads(const Eigen::VectorXd& mass, const Points3& x) const;

  bool held_, drawn_;
  Vec3 gravity_;                     // in the leaf frame of the leaf at rest
  Vec3 petiole_;                     // of the blade at rest
  Eigen::VectorXd fresh_stiffness_;  // B per segment
  double turgor_loss_;
  Points3 centreline_;
  PetioleRod rod_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace wilt
