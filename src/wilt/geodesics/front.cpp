#include "wilt/geodesics/front.hpp"

#include <algorithm>
#include <cmath>

namespace wilt::detail {
namespace {

// A front's radius of curvature may differ from a flat surface's by this factor: more is noise of a rough
// surface.
constexpr double kFocus = 10.0;
// The largest squared distance of two neighbours' nearest points on one curve, in squared edge lengths.
constexpr double kPiece = 1.2;

double norm(const Vec2& v) {
  return std::sqrt(v.x() * v.x() + v.y() * v.y());
}

double dot(const Front& front, const MarchEdge& edge) {
  return double(front.x) * edge.x + double(front.y) * edge.y;
}

double cross(const Front& front, const MarchEdge& edge) {
  return double(front.x) * edge.y - double(front.y) * edge.x;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Offers the apex the straight path from `centre`, which is at distance `offset`, if it goes through the
// edge; its root is that of `like`.
bool through(double length, const MarchFace& face, const Vec2& centre, double offset, const Front& like,
             Front& apex) {
  const double rise = face.apex_y - centre.y(),
               crossing = centre.x() * face.apex_y - centre.y() * face.apex_x;
  const double miss = kMiss * length * rise;
  if (centre.y() > 0.0 || crossing < -miss || crossing > length * rise + miss) return false;
  const double run = face.apex_x - centre.x(), way = std::sqrt(run * run + rise * rise);
  const double distance = offset + way;
  if (!(distance < kGain * apex.distance)) return false;
  const double scale = -1.0 / way, x = scale * run, y = scale * rise;
  apex = {distance, distance - (like.distance - like.radius),
          static_cast<float>(face.turn_x * x - face.turn_y * y),
          static_cast<float>(face.turn_x * y + face.turn_y * x), like.root};
  return true;
}

// The front's centre fits both distances, r_a - r_b = d_a - d_b, and its rays turn from one end to the other
// as much as the directions do: cos_b - cos_a = (l^2 - (r_a - r_b)^2) (1/r_a + 1/r_b) / (2 l).
bool from_one_root(const Front& a, const Front& b, const MarchFace& face, const MarchEdge& edge,
                   const MarchEdge& back, Front& apex) {
  const double length = edge.length;
  if (a.radius == 0.0) return through(length, face, {0.0, 0.0}, a.distance, a, apex);
  if (b.radius == 0.0) return through(length, face, {length, 0.0}, b.distance, b, apex);
  const double gap = a.distance - b.distance;
  const double turn = dot(b, back) + dot(a, edge);
  const double fitted = (length - gap) * (length + gap) / (length * turn);   // < 0: turns the wrong way
  const double sum = a.radius + b.radius, flat = 2.0 * a.radius * b.radius;  // over their sum
  double mean = fitted;
  if (!(fitted > 0.0) || fitted * sum > kFocus * flat) {
    mean = kFocus * flat / sum;
  } else if (fitted * sum * kFocus < flat) {
    mean = flat / (kFocus * sum);
  }
  const double twice =
      gap + mean + std::sqrt(gap * gap + mean * mean);  // 2 r_a, harmonic mean of r_a, r_b: mean
  const double x = 0.5 * (length + gap * (twice - gap) / length), radius = 0.5 * twice;
  return through(length, face, {x, -std::sqrt(std::max(0.0, (radius - x) * (radius + x)))},
                 a.distance - radius, a, apex);
}

// The line through both images tells which of them the apex sees: where a root would reach the other end
// sooner than its distance, that end lies in its shadow, and the line bounds the shadow. The start of the
// edge is on the left of a ray that crosses it upwards.
bool from_two_roots(const Front& a, const Front& b, double length, const MarchFace& face, const Vec2& at_a,
                    const Vec2& at_b, Front& apex) {
  const Vec2 top(face.apex_x, face.apex_y);
  const double offset_a = a.distance - a.radius, offset_b = b.distance - b.radius;
  const bool sees_a =
      offset_a + norm(at_a - Vec2(length, 0.0)) >= b.distance || cross(at_b - at_a, top - at_a) > 0.0;
  const bool sees_b = offset_b + norm(at_b) >= a.distance || cross(at_a - at_b, top - at_b) < 0.0;
  const bool from_a = sees_a && through(length, face, at_a, offset_a, a, apex);
  return (sees_b && through(length, face, at_b, offset_b, b, apex)) || from_a;
}

// The nearest point of the straight piece of curve between the nearest points of both ends. These are no
// farther apart than the ends, unless they belong to two curves or to two sides of a bend.
bool from_curve(const Front& a, const Front& b, double length, const MarchFace& face, const Vec2& at_a,
                const Vec2& at_b, Front& apex) {
  const Vec2 piece = at_b - at_a;
  const double squared = piece.squaredNorm();
  if (squared > kPiece * length * length) {
    const bool from_a = through(length, face, at_a, 0.0, a, apex);
    return through(length, face, at_b, 0.0, b, apex) || from_a;
  }
  const double reach = (Vec2(face.apex_x, face.apex_y) - at_a).dot(piece);
  const double t = squared > 0.0 ? std::clamp(reach / squared, 0.0, 1.0) : 0.0;
  return through(length, face, at_a + t * piece, 0.0, a, apex);
}

}  // namespace

bool across_face(const Front& a, const Front& b, const MarchFace& face, const MarchEdge& edge,
                 const MarchEdge& back, Front& apex) {
  if (a.root == b.root && a.root != kCurve) return from_one_root(a, b, face, edge, back, apex);
  const Vec2 at_a = a.radius * Vec2(dot(a, edge), -cross(a, edge));
  const Vec2 at_b = Vec2(edge.length, 0.0) - b.radius * Vec2(dot(b, back), -cross(b, back));
  return a.root == b.root ? from_curve(a, b, edge.length, face, at_a, at_b, apex)
                          : from_two_roots(a, b, edge.length, face, at_a, at_b, apex);
}

}  // namespace wilt::detail
