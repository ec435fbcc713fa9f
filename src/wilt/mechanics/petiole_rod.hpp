// The stalk as an elastic rod, clamped at the stem, that bends under its weight and the blade's.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// What pulls on the rod. Any consistent units.
struct RodLoads {
  Vec3 gravity = Vec3::Zero();  ///< acceleration, on the rod's own mass
  Vec3 force = Vec3::Zero();    ///< at the blade end: the blade's weight
  Vec3 arm = Vec3::Zero();      ///< from the blade end to where `force` acts, at rest; it turns with the end
  Vec3 moment = Vec3::Zero();   ///< at the blade end, in addition to arm x force; keeps its direction
};

/// Where the rod comes to rest.
struct RodEquilibrium {
  Points3 centreline;                                      ///< #K x 3, same order as given
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of the blade end, relative to rest
  int iterations = 0;
  double residual = 0.0;  ///< largest torque out of balance, relative to the largest load's torque
  bool converged = false;
};

/// A chain of rigid segments joined by rotational springs, equal in bending and twist, at the clamp and at
/// the blade end included (half a segment each), so that deflection and slope converge with the square of the
/// segment's length.
///
///     E = sum_j k_j/2 |log(Q_j^T R_{j-1}^T R_j)|^2 - loads' potential,  1/k_j = l_{j-1}/(2 B_{j-1}) + l_j/(2
///     B_j)
///
/// R_j rotation of segment j relative to rest, Q_j the natural (stress-free) rotation at the joint, B = E I
/// bending stiffness. Minimised by Newton's method with a line search on the torques; it always goes
/// downhill. O(K^3) per iteration, K some tens.
class PetioleRod {
 public:
  /// `centreline` #K x 3, K >= 2, from the blade outwards (its last point is clamped), `masses` #K - 1 per
  /// segment,
  /// >= 0. Stress-free as given. Throws Error{input}, naming the segment that is too short or the bad mass.
  PetioleRod(const Points3& centreline, const Eigen::VectorXd& masses);

  /// Declares the given centreline the equilibrium under `loads` and `stiffness`: the natural shape is bent
  /// back so that the fresh leaf hangs as it was drawn. Forgets the last equilibrium.
  void balance(const RodLoads& loads, const Eigen::VectorXd& stiffness);

  /// The equilibrium under `loads` with bending stiffness B per segment (#K - 1, > 0, force x length^2), from
  /// the last one. Throws Error{configuration}, naming the bad value.
  RodEquilibrium solve(const RodLoads& loads, const Eigen::VectorXd& stiffness);

  /// Of every segment and of the blade end, relative to rest: #K x 9, column by column. The last equilibrium,
  /// from which the next is sought.
  Eigen::MatrixXd rotations() const;
  void set_rotations(const Eigen::MatrixXd& rotations);  ///< as rotations() gave them

 private:
  Points3 centreline_;
  Eigen::VectorXd masses_;
  std::vector<Eigen::Matrix3d> natural_;    // Q_j, from the clamp to the blade end
  std::vector<Eigen::Matrix3d> rotations_;  // R_j, the last one the blade end's own
};

/// B_j = E pi r^4/4 of a round stalk, r the mean of the segment's end radii (#K): #K - 1.
Eigen::VectorXd round_bending_stiffness(const Eigen::VectorXd& radii, double youngs_modulus);

/// density pi r^2 l of each segment of a round stalk: #K - 1.
Eigen::VectorXd round_segment_masses(const Points3& centreline, const Eigen::VectorXd& radii, double density);

}  // namespace wilt
