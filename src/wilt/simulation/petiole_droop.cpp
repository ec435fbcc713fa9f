#include "wilt/simulation/petiole_droop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

constexpr double kStalkMassShare = 0.1;      // of the blade's mass
constexpr double kReferenceGravity = 0.004;  // the gravity that petiole_stiffness is stated for
constexpr double kBalanced = 1e-5;           // torque out of balance that nobody sees, of the loads'
constexpr int kUndrawnPoints = 9;
constexpr double kUndrawnLength = 0.5;   // / S
constexpr double kUndrawnRadius = 0.01;  // / S

struct StalkShape {
  Points3 centreline;  // working units
  Eigen::VectorXd radii;
};

StalkShape stalk_shape(const ModelInput& input) {
  const Stalk& stalk = input.leaf.stalk;
  if (stalk.centreline.rows() >= 2)
    return {input.scale * stalk.centreline,
            input.scale * Eigen::Map<const Eigen::VectorXd>(stalk.radii.data(), stalk.centreline.rows())};
  StalkShape shape{Points3::Zero(kUndrawnPoints, 3),
                   Eigen::VectorXd::Constant(kUndrawnPoints, kUndrawnRadius * kWorkingLength)};
  shape.centreline.col(1) = -Eigen::VectorXd::LinSpaced(kUndrawnPoints, 0.0, kUndrawnLength * kWorkingLength);
  return shape;
}

Eigen::VectorXd segment_masses(const StalkShape& stalk, double total) {
  const Eigen::VectorXd masses = round_segment_masses(stalk.centreline, stalk.radii, 1.0);
  return masses * (total / masses.sum());
}

// Bending stiffness with the profile of a round stalk and a mean of `mean`.
Eigen::VectorXd stiffness_profile(const StalkShape& stalk, double mean) {
  const Eigen::VectorXd profile = round_bending_stiffness(stalk.radii, 1.0);
  return profile * (mean / profile.mean());
}

double arc_length(const Points3& line) {
  return (line.bottomRows(line.rows() - 1) - line.topRows(line.rows() - 1)).rowwise().norm().sum();
}

}  // namespace

PetioleDroop::PetioleDroop(const ModelInput& input, const Eigen::VectorXd& mass)
    : held_(input.config.pin == "ring"),
      drawn_(input.leaf.stalk.centreline.rows() >= 2),
      gravity_(0.0, 0.0, -input.config.gravity.strength),
      petiole_(input.rest.row(input.leaf.petiole).transpose()),
      turgor_loss_(input.config.gravity.petiole_turgor_loss),
      centreline_(stalk_shape(input).centreline),
      rod_(centreline_, segment_masses(stalk_shape(input), kStalkMassShare * mass.sum())) {
  const double scale = mass.sum() * kReferenceGravity * kWorkingLength * arc_length(centreline_);
  fresh_stiffness_ = stiffness_profile(stalk_shape(input), input.config.gravity.petiole_stiffness * scale);
  rod_.balance(loads(mass, input.rest), fresh_stiffness_);
}

RodLoads PetioleDroop::loads(const Eigen::VectorXd& mass, const Points3& x) const {
  RodLoads loads;
  loads.gravity = gravity_;
  loads.force = mass.sum() * gravity_;
  loads.arm = (x.transpose() * mass) / mass.sum() - petiole_;
  return loads;
}

void PetioleDroop::advance(const Eigen::VectorXd& mass, double turgor, const Points3& x) {
  if (!held_ || gravity_.isZero()) return;
  const double share = 1.0 - turgor_loss_ * (1.0 - std::clamp(turgor, 0.0, 1.0));
  const RodEquilibrium balance = rod_.solve(loads(mass, x), share * fresh_stiffness_);
  if (!(balance.residual < kBalanced))
    throw Error(
        ErrorCode::simulation,
        fmt::format("the petiole found no balance under the blade (torque out of balance: {:.1e}); raise "
                    "gravity.petiole_stiffness",
                    balance.residual));
  rotation_ = balance.rotation;
  centreline_ = balance.centreline;
}

void PetioleDroop::exchange_state(StateArchive& archive) {
  archive.matrix("petiole.centreline", centreline_);
  archive.matrix("petiole.rotation", rotation_);
  Eigen::MatrixXd rotations = rod_.rotations();
  archive.matrix("petiole.segment_rotations", rotations);
  rod_.set_rotations(rotations);
}

DeformationModel::Hanging PetioleDroop::hanging() const {
  DeformationModel::Hanging hanging;
  hanging.rotation = rotation_;
  hanging.translation = centreline_.row(0).transpose() - rotation_ * petiole_;
  if (drawn_) hanging.stalk = centreline_;
  return hanging;
}

}  // namespace wilt
