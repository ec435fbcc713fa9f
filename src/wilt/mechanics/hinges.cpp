// Symbols: theta signed dihedral angle, W the weight min(3 l^2/a, 12), k the stiffness (Grinspun et al.
// 2003).
#include "wilt/mechanics/hinges.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mechanics/argument_checks.hpp"
#include "wilt/mechanics/hinge_geometry.hpp"

namespace wilt {
namespace {

constexpr double kLargestWeight = 12.0;

std::array<Vec3, 4> corners(const Points3& x, const int* v) {
  return {x.row(v[0]).transpose(), x.row(v[1]).transpose(), x.row(v[2]).transpose(), x.row(v[3]).transpose()};
}

double rest_weight(const std::array<Vec3, 4>& x) {
  const Vec3 edge = x[1] - x[0];
  const double area = 0.5 * (edge.cross(x[2] - x[0]).norm() + edge.cross(x[3] - x[0]).norm());
  const double length2 = edge.squaredNorm();
  return 3.0 * length2 >= kLargestWeight * area ? kLargestWeight : 3.0 * length2 / area;
}

}  // namespace

Stencil hinge_stencil(const Faces& faces) {
  struct Side {
    int low, high, opposite;
    bool forward;  // the face runs low -> high
  };
  std::vector<Side> sides;
  for (int f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, k), to = faces(f, (k + 1) % 3);
      sides.push_back({std::min(from, to), std::max(from, to), faces(f, (k + 2) % 3), from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.opposite} < std::array{b.low, b.high, b.opposite};
  });
  std::vector<std::array<int, 4>> hinges;
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const Side &a = sides[s], &b = sides[s + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const bool third = s + 2 < sides.size() && sides[s + 2].low == a.low && sides[s + 2].high == a.high;
    if (third || a.forward == b.forward)
      throw Error(ErrorCode::input,
                  fmt::format("the faces at edge {}-{} do not make an oriented surface; orient "
                              "them alike and keep two per edge",
                              a.low, a.high));
    hinges.push_back(
        {a.low, a.high, a.forward ? a.opposite : b.opposite, a.forward ? b.opposite : a.opposite});
    ++s;
  }
  Stencil stencil(static_cast<int>(hinges.size()), 4);
  for (std::size_t h = 0; h < hinges.size(); ++h) {
    for (int k = 0; k < 4; ++k) stencil(static_cast<int>(h), k) = hinges[h][k];
  }
  return stencil;
}

double hinge_angle(const Vec3& e0, const Vec3& e1, const Vec3& left, const Vec3& right) {
  return detail::hinge_derivatives({e0, e1, left, right}).angle;
}

Hinges::Hinges(const Stencil& stencil, const Points3& rest, const Eigen::VectorXd& stiffness)
    : Energy(stencil) {
  if (stencil.cols() != 4)
    throw Error(ErrorCode::configuration,
                fmt::format("a hinge has 4 vertices, not {}; take them from hinge_stencil", stencil.cols()));
  weights_.resize(element_count());
  for (int h = 0; h < element_count(); ++h) weights_[h] = rest_weight(corners(rest, vertices(h)));
  set_rest_angles(angles(rest));
  set_stiffness(stiffness);
}

void Hinges::set_rest_angles(const Eigen::VectorXd& angles) {
  detail::require_count("rest angles", angles.size(), element_count());
  detail::require_finite("the rest angle of hinge", angles);
  rest_angles_ = angles;
}

void Hinges::set_stiffness(const Eigen::VectorXd& stiffness) {
  detail::require_count("stiffnesses", stiffness.size(), element_count());
  detail::require_values("the stiffness of hinge", stiffness, 0.0, false);
  stiffness_ = stiffness;
}

Eigen::VectorXd Hinges::angles(const Points3& x) const {
  Eigen::VectorXd angles(element_count());
  for (int h = 0; h < element_count(); ++h)
    angles[h] = detail::hinge_derivatives(corners(x, vertices(h))).angle;
  return angles;
}

double Hinges::energy(const Points3& x) const {
  double sum = 0.0;
  for (int h = 0; h < element_count(); ++h) {
    const auto hinge = detail::hinge_derivatives(corners(x, vertices(h)));
    if (hinge.flat_triangle) continue;
    const double bend = hinge.angle - rest_angles_[h];
    sum += 0.5 * stiffness_[h] * weights_[h] * bend * bend;
  }
  return sum;
}

void Hinges::add_gradient(const Points3& x, Points3& gradient) const {
  for (int h = 0; h < element_count(); ++h) {
    const auto hinge = detail::hinge_derivatives(corners(x, vertices(h)));
    if (hinge.flat_triangle) continue;
    const double torque = stiffness_[h] * weights_[h] * (hinge.angle - rest_angles_[h]);
    for (int a = 0; a < 4; ++a) gradient.row(vertices(h)[a]) += torque * hinge.gradient[a].transpose();
  }
}

void Hinges::add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const {
  for (int h = 0; h < element_count(); ++h) {
    const double k = scale * stiffness_[h] * weights_[h];
    const auto points = corners(x, vertices(h));
    const auto hinge = detail::hinge_derivatives(points);
    if (hinge.flat_triangle || k == 0.0) continue;
    std::array<Eigen::Matrix3d, 10> blocks;
    for (int pair = 0; pair < 10; ++pair) {
      const auto [a, b] = detail::kHingePairs[pair];
      blocks[pair] = k * hinge.gradient[a] * hinge.gradient[b].transpose();
    }
    if (curvature == Curvature::exact) {
      const double torque = k * (hinge.angle - rest_angles_[h]);
      const auto second = detail::hinge_angle_hessian(points);
      for (int pair = 0; pair < 10; ++pair) blocks[pair] += torque * second[pair];
    }
    for (int pair = 0; pair < 10; ++pair) matrix.add(slots(h)[pair], blocks[pair]);
  }
}

}  // namespace wilt
