#include "wilt/geodesics/nearest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wilt {
namespace {

constexpr double kOnEdge = 1e-9;

// The share of the way from a to b at which the segment is nearest to p.
double along_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double square = ab.squaredNorm();
  return square > 0.0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0.0;
}

// Weights of the corners at the triangle's point nearest to p: the foot of the perpendicular where that is
// inside, else the nearest point of the three sides.
Vec3 nearest_weights(const std::array<Vec3, 3>& corners, const Vec3& p) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0], w = p - corners[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double area = uu * vv - uv * uv;
  if (area > 0.0) {
    const double s = (vv * wu - uv * wv) / area, t = (uu * wv - uv * wu) / area;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return {1.0 - s - t, s, t};
  }
  Vec3 best = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
    const double t = along_segment(p, a, b), square = (p - a - t * (b - a)).squaredNorm();
    if (square >= least) continue;
    least = square;
    best.setZero();
    best[k] = 1.0 - t;
    best[(k + 1) % 3] = t;
  }
  return best;
}

Vec3 snapped(const Vec3& weights) {
  const Vec3 kept = (weights.array() < kOnEdge).select(0.0, weights);
  return (kept.array() > 1.0 - kOnEdge).any() ? Vec3((kept.array() > 0.5).cast<double>())
                                              : Vec3(kept / kept.sum());
}

}  // namespace

NearestPoint nearest_point(const Faces& faces, const Points3& positions, const Vec3& place) {
  NearestPoint nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < faces.rows(); ++f) {
    const std::array<Vec3, 3> corners{positions.row(faces(f, 0)).transpose(),
                                      positions.row(faces(f, 1)).transpose(),
                                      positions.row(faces(f, 2)).transpose()};
    const Vec3 weights = nearest_weights(corners, place);
    const double square =
        (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - place).squaredNorm();
    if (square >= least) continue;
    least = square;
    nearest.point = {FaceId(f), weights};
  }
  nearest.point.barycentric = snapped(nearest.point.barycentric);
  nearest.distance = std::sqrt(least);
  return nearest;
}

}  // namespace wilt
