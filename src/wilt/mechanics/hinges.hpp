// Bending at the edges between two triangles.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// The interior edges of a triangle mesh as rows (e0, e1, left, right): the edge from e0 to e1, the opposite
/// vertex of the face in which it runs e0 -> e1, and that of the other face. Sorted by (min, max) of the
/// edge, e0 < e1. `faces` #F x 3 must be orientable and edge-manifold (wilt/mesh checks). Throws Error{input}
/// where it is not.
Stencil hinge_stencil(const Faces& faces);

/// The signed angle of a hinge, radians in (-pi, pi]: 0 when flat, positive when the faces fold away from
/// their normals (a ridge seen from the upper side), as in wilt/mesh/geometry.hpp.
double hinge_angle(const Vec3& e0, const Vec3& e1, const Vec3& left, const Vec3& right);

/// E = sum_h k_h/2 W_h (theta_h - theta_rest_h)^2, W = min(3 l^2/a, 12), l the edge's rest length, a the area
/// of its two triangles at rest (discrete shells, Grinspun et al. 2003).
///
/// The exact Hessian differentiates the gradient in full; the semi-definite one is Gauss-Newton,
/// k W grad(theta) grad(theta)^T, equal to it at theta = theta_rest. The energy jumps where a hinge is folded
/// shut (theta = +-pi). A triangle flatter than 1e-12 of its edge squared bends without resistance.
class Hinges : public Energy {
 public:
  /// `stencil` #H x 4 as from hinge_stencil; `rest` #V x 3; `stiffness` #H, k_h >= 0, energy. Rest angles are
  /// those of `rest`. Throws Error{configuration} for sizes and values, naming the hinge.
  Hinges(const Stencil& stencil, const Points3& rest, const Eigen::VectorXd& stiffness);

  double energy(const Points3& x) const override;
  void add_gradient(const Points3& x, Points3& gradient) const override;
  void add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const override;

  Eigen::VectorXd angles(const Points3& x) const;  ///< #H, radians
  const Eigen::VectorXd& weights() const { return weights_; }
  const Eigen::VectorXd& rest_angles() const { return rest_angles_; }
  const Eigen::VectorXd& stiffness() const { return stiffness_; }
  void set_rest_angles(const Eigen::VectorXd& angles);   ///< #H, radians
  void set_stiffness(const Eigen::VectorXd& stiffness);  ///< #H, >= 0

 private:
  Eigen::VectorXd weights_, rest_angles_, stiffness_;
};

}  // namespace wilt
