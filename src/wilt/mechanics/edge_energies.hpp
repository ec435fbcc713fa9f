// Energies that depend on the lengths of edges: springs, a limit on strain, line tension.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// E = sum_e phi_e(l_e), l_e = |x_j - x_i|. The semi-definite Hessian clamps phi' / l and phi'' at 0.
class EdgeEnergy : public Energy {
 public:
  double energy(const Points3& x) const override;
  void add_gradient(const Points3& x, Points3& gradient) const override;
  void add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const override;

  int edge_count() const { return element_count(); }

 protected:
  /// phi, phi' and phi'' at a length.
  struct Radial {
    double value, slope, curvature;
  };

  explicit EdgeEnergy(const Edges& edges) : Energy(edges) {}
  virtual Radial radial(int edge, double length) const = 0;
};

/// E = sum_e k_e/2 (l_e - L_e)^2: the elastic force of the paper, Fe_i = k_s sum_j (|x_ij| - l_ij) x_ij /
/// |x_ij|.
class Springs : public EdgeEnergy {
 public:
  /// `edges` #E x 2; `rest_lengths` #E, > 0, working lengths; `stiffness` #E, >= 0, force per length. Throws
  /// Error{configuration}, naming the edge.
  Springs(const Edges& edges, const Eigen::VectorXd& rest_lengths, const Eigen::VectorXd& stiffness);

  void set_rest_lengths(const Eigen::VectorXd& rest_lengths);
  void set_stiffness(const Eigen::VectorXd& stiffness);
  const Eigen::VectorXd& rest_lengths() const { return rest_lengths_; }
  const Eigen::VectorXd& stiffness() const { return stiffness_; }
  bool add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const override;

 protected:
  Radial radial(int edge, double length) const override;

 private:
  Eigen::VectorXd rest_lengths_, stiffness_;
};

/// E = sum_e k_e L_e^2 (|s_e| - s_0)_+^3, s_e = l_e/L_e - 1: nothing up to a strain of s_0, in tension and
/// compression alike, then a force that grows as the square of the excess. Twice continuously differentiable.
class StrainLimit : public EdgeEnergy {
 public:
  /// As for Springs; `threshold` s_0 in [0, 1). At an excess of d the force is 3 k L d^2.
  StrainLimit(const Edges& edges, const Eigen::VectorXd& rest_lengths, const Eigen::VectorXd& stiffness,
              double threshold);

  void set_rest_lengths(const Eigen::VectorXd& rest_lengths);
  void set_stiffness(const Eigen::VectorXd& stiffness);

 protected:
  Radial radial(int edge, double length) const override;

 private:
  Eigen::VectorXd rest_lengths_, stiffness_;
  double threshold_;
};

/// E = -sum_e c_e l_e: the swelling force made symmetric; c_e > 0 pushes the ends apart, on each by c_e.
class LineTension : public EdgeEnergy {
 public:
  /// `coefficients` #E, force, any sign. Throws Error{configuration} when one is not finite.
  LineTension(const Edges& edges, const Eigen::VectorXd& coefficients);

  void set_coefficients(const Eigen::VectorXd& coefficients);
  const Eigen::VectorXd& coefficients() const { return coefficients_; }
  bool add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const override;

 protected:
  Radial radial(int edge, double length) const override;

 private:
  Eigen::VectorXd coefficients_;
};

}  // namespace wilt
