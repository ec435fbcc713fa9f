// Symbols: N area normal, n its unit vector, A = |N|/2, c_i the edge opposite vertex i: dN = c_i x dx_i.
// dA/dx_i = n x c_i / 2;  d2A/dx_i dx_j = ([c_i]^T (I - n n^T) [c_j]/|N| -+ [n])/2, - for j after i, [.]
// cross matrices.
#include "wilt/mechanics/area_limit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

using Eigen::Matrix3d;

struct Triangle {
  std::array<Vec3, 3> opposite;  // c_i
  Vec3 normal;                   // n
  double length;                 // |N|

  Triangle(const Points3& x, const int* v) {
    for (int i = 0; i < 3; ++i) opposite[i] = (x.row(v[(i + 2) % 3]) - x.row(v[(i + 1) % 3])).transpose();
    normal = opposite[0].cross(opposite[1]);
    length = normal.norm();
    normal /= length;
  }
  double area() const { return 0.5 * length; }
  Vec3 gradient(int i) const { return 0.5 * normal.cross(opposite[i]); }
};

Matrix3d cross_matrix(const Vec3& a) {
  Matrix3d m;
  m << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return m;
}

Matrix3d area_hessian(const Triangle& t, int i, int j) {
  const Matrix3d across = Matrix3d::Identity() - t.normal * t.normal.transpose();
  Matrix3d block = cross_matrix(t.opposite[i]).transpose() * across * cross_matrix(t.opposite[j]) / t.length;
  if (j == (i + 1) % 3) block -= cross_matrix(t.normal);
  if (i == (j + 1) % 3) block += cross_matrix(t.normal);
  return 0.5 * block;
}

// psi(r) = (r_0/r - 1)^3 with its derivatives, for r < r_0.
struct Barrier {
  double value, slope, curvature;

  Barrier(double ratio, double threshold) {
    const double q = threshold / ratio, excess = q - 1.0;
    value = excess * excess * excess;
    slope = -3.0 * excess * excess * q / ratio;
    curvature = 6.0 * excess * q / (ratio * ratio) * (q + excess);
  }
};

}  // namespace

AreaLimit::AreaLimit(const Faces& faces, const Points3& rest, const Eigen::VectorXd& stiffness,
                     double threshold)
    : Energy(faces), rest_areas_(faces.rows()), stiffness_(stiffness), threshold_(threshold) {
  if (!(threshold > 0.0) || !(threshold < 1.0))
    throw Error(
        ErrorCode::configuration,
        fmt::format("the area limit starts at a share of {}; it must lie between 0 and 1", threshold));
  detail::require_count("stiffnesses", stiffness.size(), element_count());
  detail::require_values("the limiting stiffness of face", stiffness, 0.0, false);
  for (int f = 0; f < element_count(); ++f) rest_areas_[f] = Triangle(rest, vertices(f)).area();
  detail::require_values("the rest area of face", rest_areas_, 0.0, true);
}

double AreaLimit::energy(const Points3& x) const {
  double sum = 0.0;
  for (int f = 0; f < element_count(); ++f) {
    const double ratio = Triangle(x, vertices(f)).area() / rest_areas_[f];
    if (ratio < threshold_) sum += stiffness_[f] * rest_areas_[f] * Barrier(ratio, threshold_).value;
  }
  return sum;
}

void AreaLimit::add_gradient(const Points3& x, Points3& gradient) const {
  for (int f = 0; f < element_count(); ++f) {
    const Triangle triangle(x, vertices(f));
    const double ratio = triangle.area() / rest_areas_[f];
    if (ratio >= threshold_) continue;
    const double slope = stiffness_[f] * Barrier(ratio, threshold_).slope;
    for (int i = 0; i < 3; ++i) gradient.row(vertices(f)[i]) += slope * triangle.gradient(i).transpose();
  }
}

void AreaLimit::add_hessian(const Points3& x, BlockMatrix& matrix, double scale, Curvature curvature) const {
  for (int f = 0; f < element_count(); ++f) {
    const int* v = vertices(f);
    const Triangle triangle(x, v);
    const double ratio = triangle.area() / rest_areas_[f];
    if (ratio >= threshold_) continue;
    const Barrier barrier(ratio, threshold_);
    int pair = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j, ++pair) {
        Matrix3d block =
            barrier.curvature / rest_areas_[f] * triangle.gradient(i) * triangle.gradient(j).transpose();
        if (curvature == Curvature::exact) block += barrier.slope * area_hessian(triangle, i, j);
        block *= scale * stiffness_[f];
        matrix.add(slots(f)[pair], block);
      }
    }
  }
}

}  // namespace wilt
