// Forces along edges that have no energy: damping, and swelling as printed.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// Fd_i = k_d sum_j (v_j - v_i) (the paper; the sign that takes energy out).
class EdgeDamping : public Force {
 public:
  /// `edges` #E x 2; `coefficients` #E, >= 0, force per velocity. Throws Error{configuration}.
  EdgeDamping(const Edges& edges, const Eigen::VectorXd& coefficients);

  void add_force(const Points3& x, const Points3& v, Points3& force) const override;
  void add_jacobian(const Points3& x, const Points3& v, BlockMatrix& matrix, double position_scale,
                    double velocity_scale, Curvature curvature) const override;

  void set_coefficients(const Eigen::VectorXd& coefficients);
  bool add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const override;

 private:
  Eigen::VectorXd coefficients_;
};

/// Fp_i = sum_j c_ij (x_i - x_j)/|x_ij| with c_ij != c_ji: the swelling force as printed. Its net force is
/// not zero. Its matrix is that of the mean (c_ij + c_ji)/2 (what is left out is antisymmetric);
/// semi-definite: nothing where the mean pushes, c > 0.
class OneSidedSwelling : public Force {
 public:
  /// `edges` #E x 2; `coefficients` #E x 2: column 0 acts on edges(e, 0) (c_ij), column 1 on edges(e, 1)
  /// (c_ji). Throws Error{configuration}.
  OneSidedSwelling(const Edges& edges, const Eigen::MatrixX2d& coefficients);

  void add_force(const Points3& x, const Points3& v, Points3& force) const override;
  void add_jacobian(const Points3& x, const Points3& v, BlockMatrix& matrix, double position_scale,
                    double velocity_scale, Curvature curvature) const override;

  void set_coefficients(const Eigen::MatrixX2d& coefficients);
  bool add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const override;

 private:
  Eigen::MatrixX2d coefficients_;
};

}  // namespace wilt
