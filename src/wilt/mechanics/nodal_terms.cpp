#include "wilt/mechanics/nodal_terms.hpp"

#include "wilt/core/check.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {

Gravity::Gravity(const Eigen::VectorXd& masses, const Vec3& acceleration) {
  set_masses(masses);
  set_acceleration(acceleration);
}

void Gravity::set_masses(const Eigen::VectorXd& masses) {
  detail::require_values("the mass of vertex", masses, 0.0, false);
  masses_ = masses;
}

void Gravity::set_acceleration(const Vec3& acceleration) {
  detail::require_finite("gravity's component", acceleration);
  acceleration_ = acceleration;
}

double Gravity::energy(const Points3& x) const {
  WILT_CHECK(x.rows() == masses_.size(), x.rows(), masses_.size());
  double sum = 0.0;
  for (int i = 0; i < masses_.size(); ++i) sum -= masses_[i] * x.row(i).dot(acceleration_.transpose());
  return sum;
}

void Gravity::add_gradient(const Points3& x, Points3& gradient) const {
  WILT_CHECK(x.rows() == masses_.size(), x.rows(), masses_.size());
  for (int i = 0; i < masses_.size(); ++i) gradient.row(i) -= masses_[i] * acceleration_.transpose();
}

NodalForce::NodalForce(const Points3& values) {
  set_values(values);
}

void NodalForce::set_values(const Points3& values) {
  detail::require_finite("the force on vertex", values);
  values_ = values;
}

void NodalForce::add_force(const Points3& x, const Points3&, Points3& force) const {
  WILT_CHECK(x.rows() == values_.rows(), x.rows(), values_.rows());
  force += values_;
}

}  // namespace wilt
