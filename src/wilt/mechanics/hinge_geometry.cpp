#include "wilt/mechanics/hinge_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace wilt::detail {
namespace {

constexpr double kFlattest = 1e-12;  // |N| / |e|^2 below which a triangle has no normal

// The part of theta's derivatives that one triangle (p, q, r) brings, r opposite the edge p -> q.
struct TrianglePart {
  Vec3 edge, side, normal;  // e = q - p, r - p, N
  double length2, normal2;  // |e|^2, |N|^2
  double foot;              // t, where the height meets the edge
  Vec3 tip_gradient;        // g = d theta / dr

  TrianglePart(const Vec3& p, const Vec3& q, const Vec3& r)
      : edge(q - p),
        side(r - p),
        normal(edge.cross(side)),
        length2(edge.squaredNorm()),
        normal2(normal.squaredNorm()) {
    foot = side.dot(edge) / length2;
    tip_gradient = -std::sqrt(length2) / normal2 * normal;
  }
  bool flat() const { return !(normal2 > kFlattest * kFlattest * length2 * length2); }
};

}  // namespace

HingeDerivatives hinge_derivatives(const std::array<Vec3, 4>& x) {
  HingeDerivatives result;
  const TrianglePart a(x[0], x[1], x[2]), b(x[1], x[0], x[3]);
  result.flat_triangle = a.flat() || b.flat();
  if (result.flat_triangle) return result;
  result.angle =
      std::atan2(a.normal.cross(b.normal).dot(a.edge) / std::sqrt(a.length2), a.normal.dot(b.normal));
  result.gradient[0] = -(1.0 - a.foot) * a.tip_gradient - b.foot * b.tip_gradient;
  result.gradient[1] = -a.foot * a.tip_gradient - (1.0 - b.foot) * b.tip_gradient;
  result.gradient[2] = a.tip_gradient;
  result.gradient[3] = b.tip_gradient;
  return result;
}

}  // namespace wilt::detail
