// Symbols: phi the energy of an edge, l its length, L its rest length, n its unit vector, s = l/L - 1 its
// strain.
#include "wilt/mechanics/edge_energies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

using detail::require_count;
using detail::require_finite;
using detail::require_values;

// Two vertices in one place have no direction between them: the edge then pulls nowhere.
constexpr double kShortest = std::numeric_limits<double>::min();

Vec3 edge_vector(const Points3& x, const int* v) {
  return (x.row(v[1]) - x.row(v[0])).transpose();
}

}  // namespace

double EdgeEnergy::energy(const Points3& x) const {
  double sum = 0.0;
  for (int e = 0; e < edge_count(); ++e) sum += radial(e, edge_vector(x, vertices(e)).norm()).value;
  return sum;
}

void EdgeEnergy::add_gradient(const Points3& x, Points3& gradient) const {
  for (int e = 0; e < edge_count(); ++e) {
    const int* v = vertices(e);
    const Vec3 edge = edge_vector(x, v);
    const double length = std::max(edge.norm(), kShortest);
    const Vec3 pull = radial(e, length).slope / length * edge;
    gradient.row(v[1]) += pull.transpose();
    gradient.row(v[0]) -= pull.transpose();
  }
}

void EdgeEnergy::add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const {
  for (int e = 0; e < edge_count(); ++e) {
    const Vec3 edge = edge_vector(x, vertices(e));
    const double length = std::max(edge.norm(), kShortest);
    const Radial phi = radial(e, length);
    double across = phi.slope / length, along = phi.curvature;
    if (curvature == Curvature::semidefinite) {
      across = std::max(across, 0.0);
      along = std::max(along, 0.0);
    }
    if (across == 0.0 && along == 0.0) continue;
    const Vec3 n = edge / length;
    Eigen::Matrix3d block = scale * (along - across) * n * n.transpose();
    block.diagonal().array() += scale * across;
    const int* s = slots(e);
    matrix.add(s[0], block);
    matrix.add(s[1], -block);
    matrix.add(s[2], block);
  }
}

Springs::Springs(const Edges& edges, const Eigen::VectorXd& rest_lengths, const Eigen::VectorXd& stiffness)
    : EdgeEnergy(edges) {
  set_rest_lengths(rest_lengths);
  set_stiffness(stiffness);
}

void Springs::set_rest_lengths(const Eigen::VectorXd& rest_lengths) {
  require_count("rest lengths", rest_lengths.size(), edge_count());
  require_values("the rest length of spring", rest_lengths, 0.0, true);
  rest_lengths_ = rest_lengths;
  changed(EdgeLaw::Part::push);
}

void Springs::set_stiffness(const Eigen::VectorXd& stiffness) {
  require_count("stiffnesses", stiffness.size(), edge_count());
  require_values("the stiffness of spring", stiffness, 0.0, false);
  stiffness_ = stiffness;
  changed(EdgeLaw::Part::stiffness);
  changed(EdgeLaw::Part::push);
}

bool Springs::add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const {
  if (part == EdgeLaw::Part::stiffness)
    law.stretch += stiffness_;
  else
    for (int side = 0; side < 2; ++side) law.push.col(side) += stiffness_.cwiseProduct(rest_lengths_);
  return true;
}

EdgeEnergy::Radial Springs::radial(int edge, double length) const {
  const double k = stiffness_[edge], stretch = length - rest_lengths_[edge];
  return {0.5 * k * stretch * stretch, k * stretch, k};
}

StrainLimit::StrainLimit(const Edges& edges, const Eigen::VectorXd& rest_lengths,
                         const Eigen::VectorXd& stiffness, double threshold)
    : EdgeEnergy(edges), threshold_(threshold) {
  if (!(threshold >= 0.0) || !(threshold < 1.0))
    throw Error(ErrorCode::configuration,
                fmt::format("the strain limit starts at a strain of {}; it must be at least 0 and below 1",
                            threshold));
  set_rest_lengths(rest_lengths);
  set_stiffness(stiffness);
}

void StrainLimit::set_rest_lengths(const Eigen::VectorXd& rest_lengths) {
  require_count("rest lengths", rest_lengths.size(), edge_count());
  require_values("the rest length of edge", rest_lengths, 0.0, true);
  rest_lengths_ = rest_lengths;
}

void StrainLimit::set_stiffness(const Eigen::VectorXd& stiffness) {
  require_count("stiffnesses", stiffness.size(), edge_count());
  require_values("the limiting stiffness of edge", stiffness, 0.0, false);
  stiffness_ = stiffness;
}

EdgeEnergy::Radial StrainLimit::radial(int edge, double length) const {
  const double rest = rest_lengths_[edge], k = stiffness_[edge];
  const double strain = length / rest - 1.0, excess = std::abs(strain) - threshold_;
  if (excess <= 0.0) return {0.0, 0.0, 0.0};
  const double slope = 3.0 * k * rest * excess * excess;
  return {k * rest * rest * excess * excess * excess, strain > 0.0 ? slope : -slope, 6.0 * k * excess};
}

LineTension::LineTension(const Edges& edges, const Eigen::VectorXd& coefficients) : EdgeEnergy(edges) {
  set_coefficients(coefficients);
}

void LineTension::set_coefficients(const Eigen::VectorXd& coefficients) {
  require_count("coefficients", coefficients.size(), edge_count());
  require_finite("the line tension of edge", coefficients);
  coefficients_ = coefficients;
  changed(EdgeLaw::Part::push);
}

bool LineTension::add_edge_law(EdgeLaw& law, EdgeLaw::Part part) const {
  if (part == EdgeLaw::Part::push) law.push.colwise() += coefficients_;
  return true;
}

EdgeEnergy::Radial LineTension::radial(int edge, double length) const {
  return {-coefficients_[edge] * length, -coefficients_[edge], 0.0};
}

}  // namespace wilt
