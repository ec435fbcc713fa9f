// Loads on single vertices: gravity and given forces.
#pragma once

#include <Eigen/Core>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// E = -sum_i m_i g . x_i.
class Gravity : public Energy {
 public:
  /// `masses` #V, >= 0; `acceleration` g, working length per time squared. Throws Error{configuration}.
  Gravity(const Eigen::VectorXd& masses, const Vec3& acceleration);

  double energy(const Points3& x) const override;
  void add_gradient(const Points3& x, Points3& gradient) const override;
  void add_hessian(const Points3&, BlockMatrix&, double, Curvature) const override {}
  bool is_load() const override { return true; }

  void set_masses(const Eigen::VectorXd& masses);
  void set_acceleration(const Vec3& acceleration);

 private:
  Eigen::VectorXd masses_;
  Vec3 acceleration_;
};

/// A force per vertex that stays as it is during a step.
class NodalForce : public Force {
 public:
  /// `values` #V x 3, finite. Throws Error{configuration}.
  explicit NodalForce(const Points3& values);

  void add_force(const Points3& x, const Points3& v, Points3& force) const override;
  void add_jacobian(const Points3&, const Points3&, BlockMatrix&, double, double, Curvature) const override {}
  bool is_load() const override { return true; }

  void set_values(const Points3& values);
  const Points3& values() const { return values_; }

 private:
  Points3 values_;
};

}  // namespace wilt
