// Bending at the edges between two triangles.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/index_lists.hpp"
#include "wilt/core/simd.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mechanics/single_blocks.hpp"
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
/// In the matrix it is Gauss-Newton's, k W grad(theta) grad(theta)^T: semi-definite, and the Hessian at theta
/// = theta_rest; elsewhere the Hessian has a part with theta's second derivative more, which would
/// spare Newton a sixth of its iterations at several times the price of the matrix. The energy jumps where a
/// hinge is folded shut (theta = +-pi). A triangle flatter than 1e-12 of its edge squared bends without
/// resistance.
///
/// Eight hinges at a time; each writes what it does to its own corners, and vertices and blocks gather that:
/// the same bytes on any number of threads. One call at a time.
class Hinges : public Energy {
 public:
  /// `stencil` #H x 4 as from hinge_stencil; `rest` #V x 3; `stiffness` #H, k_h >= 0, energy. Rest angles are
  /// those of `rest`. Throws Error{configuration} for sizes and values, naming the hinge.
  Hinges(const Stencil& stencil, const Points3& rest, const Eigen::VectorXd& stiffness);

  double energy(const Points3& x) const override;
  void add_gradient(const Points3& x, Points3& gradient) const override;
  void add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature) const override;
  void bind(const BlockPattern& pattern) override;

  Eigen::VectorXd angles(const Points3& x) const;  ///< #H, radians
  const Eigen::VectorXd& weights() const { return weights_; }
  const Eigen::VectorXd& rest_angles() const { return rest_angles_; }
  const Eigen::VectorXd& stiffness() const { return stiffness_; }
  void set_rest_angles(const Eigen::VectorXd& angles);   ///< #H, radians
  void set_stiffness(const Eigen::VectorXd& stiffness);  ///< #H, >= 0

 private:
  int group_count() const { return static_cast<int>(moduli8_.size()); }
  void group_corners(int vertex_count);

  Eigen::VectorXd weights_, rest_angles_, stiffness_;

  // By groups of eight hinges; k = 0 where a group has no further hinge.
  std::vector<int> corners8_;                    // 4 x 8 vertices per group
  std::vector<Number8> moduli8_, rest_angles8_;  // k W, theta_rest

  // Corner a of hinge h is 4 h + a; the pair of its corners a and b is 4 (4 h + a) + b.
  IndexLists vertex_corners_;  // per vertex
  IndexLists slot_corners_;    // pairs, per block of the matrix
  mutable std::vector<Point4> corner_forces_;
  mutable std::vector<detail::SinglePoint> corner_slopes_;
};

}  // namespace wilt
