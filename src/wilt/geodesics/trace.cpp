#include "wilt/geodesics/trace.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

// A barycentric coordinate below this is 0: the point lies on the edge.
constexpr double kOnEdge = 1e-12;
// Steps of a path that turns: in edge lengths of the face, and, where these are tiny, of its longest length.
constexpr double kStep = 0.1;
constexpr double kSmallStep = 1.0 / 500.0;

// The face's orthonormal frame and the change of the barycentric coordinates along it.
struct FacePlane {
  Vec3 origin, x, y;
  std::array<Vec2, 3> corners;
  std::array<Vec2, 3> gradients;  // of the barycentric coordinates
};

FacePlane face_plane(const SurfaceMesh& mesh, const Points3& positions, FaceId f) {
  const auto [a, b, c] = mesh.face_vertices(f);
  FacePlane plane;
  plane.origin = positions.row(a);
  const Vec3 ab = positions.row(b) - positions.row(a), ac = positions.row(c) - positions.row(a);
  const Vec3 normal = ab.cross(ac);
  if (!(normal.norm() > 0.0))
    throw Error(
        ErrorCode::input,
        fmt::format("face {} has no area or a position that is not finite; paths need proper triangles",
                    int(f)));
  plane.x = ab.normalized();
  plane.y = normal.normalized().cross(plane.x);
  plane.corners = {Vec2(0.0, 0.0), Vec2(ab.norm(), 0.0), Vec2(ac.dot(plane.x), ac.dot(plane.y))};
  for (int k = 0; k < 3; ++k) {
    const Vec2 edge = plane.corners[(k + 2) % 3] - plane.corners[(k + 1) % 3];
    plane.gradients[k] = Vec2(-edge.y(), edge.x()) / normal.norm();
  }
  return plane;
}

// A walker in a face: where it is, and its unit direction in the face's plane.
class Walker {
 public:
  Walker(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start)
      : mesh_(mesh), positions_(positions), point_(start), plane_(face_plane(mesh, positions, start.face)) {}

  const SurfacePoint& point() const { return point_; }

  /// Takes the tangential part of `direction`; false when there is none.
  bool head(const Vec3& direction) {
    heading_ = {direction.dot(plane_.x), direction.dot(plane_.y)};
    const double tangential = heading_.norm();
    if (!(tangential > 1e-12 * direction.norm())) return false;
    heading_ /= tangential;
    return true;
  }

  /// Whether the direction leads from the point into the face, not out of it at once.
  bool leads_inside() const {
    for (int k = 0; k < 3; ++k) {
      if (point_.barycentric[k] == 0.0 && heading_.dot(plane_.gradients[k]) < 0.0) return false;
    }
    return true;
  }

  void turn_left(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    heading_ = Vec2(c * heading_.x() - s * heading_.y(), s * heading_.x() + c * heading_.y());
  }

  /// The mean of the face's.
  double edge_length() const {
    const auto& [a, b, c] = plane_.corners;
    return ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3.0;
  }

  /// How far it is to the side ahead, and which one.
  double reach(int* side) const {
    double distance = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const double rate = heading_.dot(plane_.gradients[k]);
      if (rate >= 0.0 || point_.barycentric[k] / -rate >= distance) continue;
      distance = point_.barycentric[k] / -rate;
      *side = k;
    }
    return distance;
  }

  /// Goes on in this face by at most `length`; returns how far it came.
  double advance(double length) {
    int side = -1;
    const double ahead = reach(&side), distance = std::min(length, ahead);
    side_ = ahead <= length ? side : -1;
    for (int k = 0; k < 3; ++k) {
      double& w = point_.barycentric[k];
      w += distance * heading_.dot(plane_.gradients[k]);
      if (k == side_ || w < kOnEdge) w = 0.0;
    }
    point_.barycentric /= point_.barycentric.sum();
    return distance;
  }

  bool at_side() const { return side_ >= 0; }

  /// Crosses the side on which it stands; false at the margin.
  bool cross() {
    const HalfedgeId first = mesh_.halfedge(point_.face);
    const std::array<HalfedgeId, 3> around{first, mesh_.next(first), mesh_.prev(first)};
    const int from = (side_ + 1) % 3;
    const HalfedgeId twin = mesh_.twin(around[from]);
    if (mesh_.is_boundary(twin)) return false;
    // The angle with the edge is the same on both sides.
    const Vec2 edge = (plane_.corners[(from + 1) % 3] - plane_.corners[from]).normalized();
    const double along = heading_.dot(edge), out = edge.y() * heading_.x() - edge.x() * heading_.y();
    point_ = in_face(mesh_, point_, mesh_.face(twin));
    plane_ = face_plane(mesh_, positions_, point_.face);
    const int k = twin - mesh_.halfedge(point_.face);  // it runs against the edge
    const Vec2 back = (plane_.corners[k] - plane_.corners[(k + 1) % 3]).normalized();
    heading_ = along * back + out * Vec2(back.y(), -back.x());
    // The face lies to the left of its halfedge, which is to the right of `back`.
    return true;
  }

 private:
  const SurfaceMesh& mesh_;
  const Points3& positions_;
  SurfacePoint point_;
  FacePlane plane_;
  Vec2 heading_ = Vec2::UnitX();
  int side_ = -1;
};

void check_arguments(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start,
                     double max_length) {
  if (positions.rows() != mesh.num_vertices())
    throw Error(ErrorCode::input,
                fmt::format("{} positions were given for a mesh of {} vertices; give one each",
                            positions.rows(), mesh.num_vertices()));
  const Vec3& w = start.barycentric;
  if (start.face < 0 || start.face >= mesh.num_faces() || !(w.minCoeff() >= 0.0) ||
      !(std::abs(w.sum() - 1.0) < 1e-9))
    throw Error(
        ErrorCode::input,
        fmt::format("a path cannot start at ({}, {}, {}) in face {}; its coordinates must be >= 0 and sum to "
                    "1, in a face from 0 to {}",
                    w[0], w[1], w[2], int(start.face), mesh.num_faces() - 1));
  if (!(max_length > 0.0) || !std::isfinite(max_length))
    throw Error(ErrorCode::configuration,
                fmt::format("the path's maximum length is {}; it must be positive and finite", max_length));
}

// A walker in the face around `start` into which the direction points; in the start's own face when none.
Walker walker_at(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start,
                 const Vec3& direction) {
  bool tangential = false;
  for (const FaceId f : faces_at(mesh, start)) {
    Walker walker(mesh, positions, in_face(mesh, start, f));
    if (!walker.head(direction)) continue;
    tangential = true;
    if (walker.leads_inside()) return walker;
  }
  if (!tangential)
    throw Error(
        ErrorCode::configuration,
        fmt::format(
            "the direction ({}, {}, {}) has no part along the surface at the start; choose one that is "
            "not normal to it",
            direction.x(), direction.y(), direction.z()));
  Walker walker(mesh, positions, start);
  walker.head(direction);
  return walker;
}

}  // namespace

SurfacePath trace_straight(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start,
                           const Vec3& direction, double max_length,
                           const std::function<double(double)>& turn,
                           const std::function<bool(const SurfacePoint&)>& stop) {
  check_arguments(mesh, positions, start, max_length);
  Walker walker = walker_at(mesh, positions, start, direction);
  SurfacePath path{{start}, 0.0};
  // A path that circles a vertex at no distance would never end.
  int idle = 0;
  while (path.length < max_length && idle < 3 * mesh.num_faces()) {
    const double longest =
        turn ? std::max(kStep * walker.edge_length(), kSmallStep * max_length) : max_length;
    double step = std::min(longest, max_length - path.length);
    // A turning step ends at the side ahead, or the side would cut its middle off.
    int side = -1;
    const double ahead = walker.reach(&side);
    if (turn && ahead > 0.0) step = std::min(step, ahead);
    // The middle of the step decides its direction: second order in the step.
    const double angle = turn ? turn(path.length + 0.5 * step) * step : 0.0;
    walker.turn_left(0.5 * angle);
    const double walked = walker.advance(step);
    walker.turn_left(angle * (walked / step - 0.5));
    path.length += walked;
    idle = walked > 0.0 ? 0 : idle + 1;
    if (walked > 0.0) {
      path.points.push_back(walker.point());
      if (stop && stop(walker.point())) break;
    }
    if (walker.at_side() && !walker.cross()) break;
  }
  return path;
}

}  // namespace wilt
