#include "wilt/mechanics/edge_forces.hpp"

#include <algorithm>
#include <limits>

#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

// The block B of an edge acts as B on the diagonal and -B off it.
void add_edge_block(BlockMatrix& matrix, const int* slots, const Eigen::Matrix3d& block) {
  matrix.add(slots[0], block);
  matrix.add(slots[1], -block);
  matrix.add(slots[2], block);
}

}  // namespace

EdgeDamping::EdgeDamping(const Edges& edges, const Eigen::VectorXd& coefficients) : Force(edges) {
  set_coefficients(coefficients);
}

void EdgeDamping::set_coefficients(const Eigen::VectorXd& coefficients) {
  detail::require_count("coefficients", coefficients.size(), element_count());
  detail::require_values("the damping of edge", coefficients, 0.0, false);
  coefficients_ = coefficients;
  changed(EdgeLaw::Part::stiffness);
}

bool EdgeDamping::add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const {
  if (part == EdgeLaw::Part::stiffness) law.damping += coefficients_;
  return true;
}

void EdgeDamping::add_force(const Points3&, const Points3& v, Points3& force) const {
  for (int e = 0; e < element_count(); ++e) {
    const int i = vertices(e)[0], j = vertices(e)[1];
    const Vec3 drag = coefficients_[e] * (v.row(j) - v.row(i)).transpose();
    force.row(i) += drag.transpose();
    force.row(j) -= drag.transpose();
  }
}

void EdgeDamping::add_jacobian(const Points3&, const Points3&, BlockMatrix& matrix, double,
                               double velocity_scale, Curvature) const {
  for (int e = 0; e < element_count(); ++e)
    add_edge_block(matrix, slots(e), velocity_scale * coefficients_[e] * Eigen::Matrix3d::Identity());
}

OneSidedSwelling::OneSidedSwelling(const Edges& edges, const Eigen::MatrixX2d& coefficients) : Force(edges) {
  set_coefficients(coefficients);
}

void OneSidedSwelling::set_coefficients(const Eigen::MatrixX2d& coefficients) {
  detail::require_count("pairs of coefficients", coefficients.rows(), element_count());
  detail::require_finite("the swelling of edge", coefficients);
  coefficients_ = coefficients;
  changed(EdgeLaw::Part::push);
}

bool OneSidedSwelling::add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const {
  if (part == EdgeLaw::Part::push) law.push += coefficients_;
  return true;
}

void OneSidedSwelling::add_force(const Points3& x, const Points3&, Points3& force) const {
  for (int e = 0; e < element_count(); ++e) {
    const int i = vertices(e)[0], j = vertices(e)[1];
    const Vec3 edge = (x.row(j) - x.row(i)).transpose();
    const Vec3 n = edge / std::max(edge.norm(), std::numeric_limits<double>::min());
    force.row(i) -= coefficients_(e, 0) * n.transpose();
    force.row(j) += coefficients_(e, 1) * n.transpose();
  }
}

void OneSidedSwelling::add_jacobian(const Points3& x, const Points3&, BlockMatrix& matrix,
                                    double position_scale, double, Curvature curvature) const {
  for (int e = 0; e < element_count(); ++e) {
    const Vec3 edge = (x.row(vertices(e)[1]) - x.row(vertices(e)[0])).transpose();
    const double length = std::max(edge.norm(), std::numeric_limits<double>::min());
    const Vec3 n = edge / length;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
    // -dF_i/dx_i = -c_ij across/l, -dF_j/dx_j = -c_ji across/l, off the diagonal +c; their mean is off it.
    const double scale = -position_scale / length;
    const double c0 = coefficients_(e, 0), c1 = coefficients_(e, 1), mean = 0.5 * (c0 + c1);
    if (curvature == Curvature::semidefinite) {
      if (mean < 0.0) add_edge_block(matrix, slots(e), scale * mean * across);
      continue;
    }
    matrix.add(slots(e)[0], scale * c0 * across);
    matrix.add(slots(e)[1], -scale * mean * across);
    matrix.add(slots(e)[2], scale * c1 * across);
  }
}

}  // namespace wilt
