// An energy that keeps triangles from collapsing.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/simd.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// E = sum_f k_f A_f (r_0/r_f - 1)_+^3, r_f = area / rest area A_f: nothing while a triangle keeps more than
/// the share r_0 of its area, growing without bound as it collapses. Twice continuously differentiable.
///
/// Springs let a triangle fold through in its plane without much strain; a hinge at it then jumps by pi, and
/// no time step is small enough for that. The semi-definite Hessian leaves out the area's own second
/// derivative. A triangle without area gives an infinite energy and a gradient that is not finite.
class AreaLimit : public Energy {
 public:
  /// `faces` #F x 3; `rest` #V x 3; `stiffness` #F, k_f >= 0, force per length; `threshold` r_0 in (0, 1).
  /// Throws Error{configuration}, naming the face, for these and for a face without area at rest.
  AreaLimit(const Faces& faces, const Points3& rest, const Eigen::VectorXd& stiffness, double threshold);

  double energy(const Points3& x) const override;
  void add_gradient(const Points3& x, Points3& gradient) const override;
  void add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const override;

 private:
  std::vector<int> squeezed(const Points3& x) const;

  Eigen::VectorXd rest_areas_, stiffness_;
  double threshold_;
  // By groups of eight faces; the last face fills up the last group.
  std::vector<int> corners8_;    // 3 x 8 vertices per group
  std::vector<Number8> least8_;  // |N|^2 from which on there is surely no force
};

}  // namespace wilt
