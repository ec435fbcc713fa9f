// Scans of leaves whose surface is known.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/core/random.hpp"
#include "wilt/import/regions.hpp"
#include "wilt/leaf/blade_outline.hpp"
#include "wilt/leaf/outline.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt::test {

/// Three numbers in an order of ours: arguments of one call are evaluated in the compiler's.
inline Vec3 normal_point(Random& random) {
  const double z = random.normal(), y = random.normal(), x = random.normal();
  return {x, y, z};
}

/// A flat blade 100 long, rolled about the axis x = 0, z = radius: (x, y) goes to
/// (radius sin(x / radius), y, radius - radius cos(x / radius)), which keeps all lengths.
class RolledBlade {
 public:
  RolledBlade(std::string_view species, double radius) : radius_(radius), blade_(blade_outline(species, 3)) {
    blade_.outline.margin *= kLength;
    for (Vec2& tip : blade_.tips) tip *= kLength;
  }
  static constexpr double kLength = 100.0;

  const Outline& outline() const { return blade_.outline; }
  const std::vector<Vec2>& tips() const { return blade_.tips; }

  Vec3 roll(const Vec2& p) const {
    return {radius_ * std::sin(p.x() / radius_), p.y(), radius_ - radius_ * std::cos(p.x() / radius_)};
  }
  /// The place in the plane below or above which a point lies, and its height over the surface.
  Vec2 unroll(const Vec3& p) const { return {radius_ * std::atan2(p.x(), radius_ - p.z()), p.y()}; }
  double height(const Vec3& p) const { return radius_ - std::hypot(p.x(), radius_ - p.z()); }

  /// `count` points spread at random, each coordinate off by a normal error.
  std::vector<Vec3> scan(int count, double noise) const {
    MeshingOptions meshing;
    meshing.vertices = 4000;
    const PlanarMesh planar = mesh_outline(blade_.outline, meshing);
    Points3 flat = Points3::Zero(planar.positions.rows(), 3);
    flat.leftCols<2>() = planar.positions;
    const FaceData<double> areas = face_areas(planar.mesh, flat);
    std::vector<double> up_to;
    double total = 0.0;
    for (const FaceId f : planar.mesh.faces()) up_to.push_back(total += areas[f]);
    Random random(7, "test scan");
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const auto face =
          std::upper_bound(up_to.begin(), up_to.end(), random.uniform(0.0, total)) - up_to.begin();
      const auto v = planar.mesh.face_vertices(FaceId(static_cast<int>(face)));
      double a = random.uniform(), b = random.uniform();
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      const Vec2 at = (a * planar.positions.row(v[0]) + b * planar.positions.row(v[1]) +
                       (1.0 - a - b) * planar.positions.row(v[2]))
                          .transpose();
      points.push_back(roll(at) + noise * normal_point(random));
    }
    return points;
  }

 private:
  double radius_;
  BladeOutline blade_;
};

inline std::string lines(const std::vector<Vec3>& points, const char* separator = " ") {
  std::string text;
  for (const Vec3& p : points)
    text += fmt::format("{1:.6f}{0}{2:.6f}{0}{3:.6f}\n", separator, p.x(), p.y(), p.z());
  return text;
}

/// The vertices of a leaf where the file has them.
inline Points3 in_file(const Leaf& leaf) {
  return ((leaf.placement.scale * leaf.positions) * leaf.placement.rotation.transpose()).rowwise() +
         leaf.placement.translation.transpose();
}

/// Area shared over area covered, of two outlines.
inline double overlap_ratio(const Outline& a, const Outline& b) {
  const detail::RegionGrid grid(
      a.margin.colwise().minCoeff().cwiseMin(b.margin.colwise().minCoeff()).transpose(),
      a.margin.colwise().maxCoeff().cwiseMax(b.margin.colwise().maxCoeff()).transpose());
  const double both = grid.overlap(a, b);
  return both / (detail::area_of(a) + detail::area_of(b) - both);
}

}  // namespace wilt::test
