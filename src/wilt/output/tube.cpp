#include "wilt/output/tube.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

// Unit tangents by central differences; a point on top of its neighbours takes the tangent before it.
Points3 tangents(const Points3& centreline) {
  const int count = static_cast<int>(centreline.rows());
  Points3 result(count, 3);
  Vec3 last = -Vec3::UnitY();
  for (int k = 0; k < count; ++k) {
    const Vec3 across = centreline.row(std::min(k + 1, count - 1)) - centreline.row(std::max(k - 1, 0));
    if (across.norm() > 0.0) last = across.normalized();
    result.row(k) = last;
  }
  return result;
}

// A unit vector across `tangent`, as near to `wish` as can be.
Vec3 perpendicular(const Vec3& tangent, const Vec3& wish) {
  const Vec3 across = wish - tangent.dot(wish) * tangent;
  return across.norm() > 1e-6 ? across.normalized() : tangent.unitOrthogonal();
}

void add_cap(Tube& tube, int first_vertex, int first_face, int ring, int sides, const Vec3& centre,
             const Vec3& normal, bool reversed) {
  for (int s = 0; s < sides; ++s) {
    const int next = (s + 1) % sides;
    tube.positions.row(first_vertex + s) = tube.positions.row(ring + s);
    tube.normals.row(first_vertex + s) = normal;
    tube.faces.row(first_face + s) << first_vertex + (reversed ? next : s),
        first_vertex + (reversed ? s : next), first_vertex + sides;
  }
  tube.positions.row(first_vertex + sides) = centre;
  tube.normals.row(first_vertex + sides) = normal;
}

}  // namespace

Vec3 tube_reference(const Points3& centreline) {
  const Vec3 tangent = tangents(centreline).row(0);
  return std::abs(tangent.x()) <= std::abs(tangent.z()) ? Vec3::UnitX() : Vec3::UnitZ();
}

Tube tube(const Points3& centreline, const std::vector<double>& radii, int sides, const Vec3& reference) {
  const int count = static_cast<int>(centreline.rows());
  WILT_CHECK(count >= 2 && sides >= 3 && count == static_cast<int>(radii.size()), count, sides, radii.size());
  Tube result;
  result.positions.resize(count * sides + 2 * (sides + 1), 3);
  result.normals.resize(result.positions.rows(), 3);
  result.faces.resize(2 * (count - 1) * sides + 2 * sides, 3);

  const Points3 directions = tangents(centreline);
  Vec3 along = directions.row(0);
  Vec3 u = perpendicular(along, reference);
  int f = 0;
  for (int k = 0; k < count; ++k) {
    const Vec3 tangent = directions.row(k);
    u = perpendicular(tangent, Eigen::Quaterniond::FromTwoVectors(along, tangent) * u);
    along = tangent;
    const Vec3 v = tangent.cross(u);
    for (int s = 0; s < sides; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / sides;
      const Vec3 normal = std::cos(angle) * u + std::sin(angle) * v;
      const int here = k * sides + s, next = k * sides + (s + 1) % sides;
      result.positions.row(here) = centreline.row(k) + radii[k] * normal.transpose();
      result.normals.row(here) = normal;
      if (k + 1 == count) continue;
      result.faces.row(f++) << here, next, next + sides;
      result.faces.row(f++) << here, next + sides, here + sides;
    }
  }
  const int last = (count - 1) * sides, caps = count * sides;
  add_cap(result, caps, f, 0, sides, centreline.row(0), -directions.row(0).transpose(), true);
  add_cap(result, caps + sides + 1, f + sides, last, sides, centreline.row(count - 1),
          directions.row(count - 1), false);
  return result;
}

}  // namespace wilt
