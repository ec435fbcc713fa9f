#include "wilt/mechanics/hinge_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace wilt::detail {
namespace {

using Eigen::Matrix3d;

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

Matrix3d cross_matrix(const Vec3& a) {
  Matrix3d m;
  m << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return m;
}

// Second derivatives of one triangle's part by p, q, r.
struct TriangleHessian {
  Matrix3d rp, rq, rr, pp, pq, qp, qq;

  explicit TriangleHessian(const TrianglePart& part) {
    const double length = std::sqrt(part.length2);
    const Vec3& e = part.edge;
    const Vec3& g = part.tip_gradient;
    const double t = part.foot;
    // dN = e x dr + (r - q) x dp - (r - p) x dq, and S = dg/dN.
    const Matrix3d s = -length / part.normal2 *
                       (Matrix3d::Identity() - 2.0 / part.normal2 * part.normal * part.normal.transpose());
    const Matrix3d u = part.normal / (part.normal2 * length) * e.transpose();
    const Matrix3d from_side = s * cross_matrix(part.side);
    rr = s * cross_matrix(e);
    rp = from_side - rr + u;
    rq = -from_side - u;
    const Vec3 dt_dp = ((2.0 * t - 1.0) * e - part.side) / part.length2;
    const Vec3 dt_dq = (part.side - 2.0 * t * e) / part.length2;
    pp = -(1.0 - t) * rp + g * dt_dp.transpose();
    pq = -(1.0 - t) * rq + g * dt_dq.transpose();
    qp = -t * rp - g * dt_dp.transpose();
    qq = -t * rq - g * dt_dq.transpose();
  }
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

std::array<Matrix3d, 10> hinge_angle_hessian(const std::array<Vec3, 4>& x) {
  const TriangleHessian a(TrianglePart(x[0], x[1], x[2])), b(TrianglePart(x[1], x[0], x[3]));
  return {a.pp + b.qq,      a.pq + b.qp,
          a.rp.transpose(), b.rq.transpose(),
          a.qq + b.pp,      a.rq.transpose(),
          b.rp.transpose(), a.rr,
          Matrix3d::Zero(), b.rr};
}

}  // namespace wilt::detail
