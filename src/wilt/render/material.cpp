#include "wilt/render/material.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wilt/core/srgb.hpp"

namespace wilt {
namespace {

constexpr double kClearance = 2e-4;  // world units: rays start so far from the sheet

struct Corners {
  Vec3 position[3], normal[3];
};

Corners corners(const Surface& surface, int face, double side) {
  Corners c;
  for (int i = 0; i < 3; ++i) {
    c.position[i] = surface.positions.row(surface.faces(face, i)).transpose();
    c.normal[i] = side * surface.normals.row(surface.faces(face, i)).transpose();
  }
  return c;
}

// Moves a point of a coarse, smoothly shaded mesh outwards onto the smooth surface, so that facets do not
// shadow themselves (J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021).
Vec3 smooth_origin(const Corners& c, const Vec3& weights, const Vec3& p, double side) {
  Vec3 lift = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 normal = side * c.normal[i];
    lift -= weights[i] * std::min(0.0, (p - c.position[i]).dot(normal)) * normal;
  }
  return p + lift;
}

template <class Rows>
auto interpolate(const Rows& values, const Surface& surface, const Hit& hit) {
  const auto v = surface.faces.row(hit.face);
  return (hit.weights[0] * values.row(v[0]) + hit.weights[1] * values.row(v[1]) +
          hit.weights[2] * values.row(v[2]))
      .transpose()
      .eval();
}

// The gradients of u and v on a face, in world units.
struct UvGradients {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
};

UvGradients uv_gradients(const Surface& surface, const Hit& hit, const Corners& c) {
  const auto uv = [&](int i) -> Vec2 { return surface.uv.row(surface.faces(hit.face, i)).transpose(); };
  const Vec2 ab = uv(1) - uv(0), ac = uv(2) - uv(0);
  const Vec3 p = c.position[1] - c.position[0], q = c.position[2] - c.position[0], n = p.cross(q);
  const double area2 = n.squaredNorm();
  if (area2 <= 0.0) return {};
  const Vec3 b = q.cross(n) / area2, d = n.cross(p) / area2;  // of the second and third weight
  return {ab.x() * b + ac.x() * d, ab.y() * b + ac.y() * d};
}

// The normal of a tangent-space map: x along u, y against v, z along the smooth normal of the upper side.
Vec3 mapped_normal(const Vec3& value, const UvGradients& gradients, const Vec3& upper_normal, double relief) {
  const auto tangent = [&](const Vec3& gradient) -> Vec3 {
    const Vec3 along = gradient - upper_normal * upper_normal.dot(gradient);
    const double length = along.norm();
    return length > 0.0 ? Vec3(along / length) : Vec3(Vec3::Zero());
  };
  return (upper_normal * std::max(value.z(), 0.05) +
          relief * (value.x() * tangent(gradients.u) - value.y() * tangent(gradients.v)))
      .normalized();
}

// Keeps what is reflected plus what is transmitted within the light that arrives.
void conserve(ShadingPoint& point) {
  for (int i = 0; i < 3; ++i) {
    const double sum = point.reflectance[i] + point.transmittance[i];
    if (sum > 1.0) point.reflectance[i] /= sum, point.transmittance[i] /= sum;
  }
}

}  // namespace

SheetOptics sheet_optics(const Vec3& upper_colour, double translucency) {
  const double brightest = std::max(upper_colour.maxCoeff(), 1e-6);
  const double grey = luminance(upper_colour);
  const Vec3 saturation = (upper_colour / brightest).cwiseSqrt();
  SheetOptics optics;
  optics.upper = upper_colour;
  // Half-way to a grey between its own and its brightest channel.
  optics.under = upper_colour + 0.45 * (Vec3::Constant(0.5 * (grey + brightest)) - upper_colour);
  optics.transmittance = translucency * upper_colour.cwiseProduct(saturation);
  return optics;
}

ShadingPoint shading_point(const World& world, const Ray& ray, const Hit& hit, double footprint) {
  const Surface& surface = world.scene().surfaces[std::size_t(hit.surface)];
  const Maps& maps = world.maps(hit.surface);
  const bool upper = hit.geometric_normal.dot(ray.direction) < 0.0;
  const double side = upper ? 1.0 : -1.0;
  const Corners c = corners(surface, hit.face, side);
  const Vec3 p =
      c.position[0] * hit.weights[0] + c.position[1] * hit.weights[1] + c.position[2] * hit.weights[2];
  const Vec3 geometric = side * hit.geometric_normal;

  ShadingPoint point;
  point.front = smooth_origin(c, hit.weights, p, 1.0) + kClearance * geometric;
  point.back = smooth_origin(c, hit.weights, p, -1.0) - kClearance * geometric;
  point.gloss = surface.finish.gloss, point.roughness = surface.finish.roughness;
  Vec3 colour = interpolate(surface.colours, surface, hit);
  Vec3 normal = (side * interpolate(surface.normals, surface, hit)).normalized();
  if (normal.dot(geometric) < 0.0) normal = geometric;
  if (!maps.colour.empty() || !maps.normal.empty()) {
    const Vec2 uv = interpolate(surface.uv, surface, hit);
    const UvGradients gradients = uv_gradients(surface, hit, c);
    const double on_map = footprint * std::sqrt(gradients.u.norm() * gradients.v.norm());
    if (!maps.colour.empty()) colour = colour.cwiseProduct(maps.colour.at(uv, on_map));
    if (!maps.normal.empty())
      normal =
          side * mapped_normal(maps.normal.at(uv, on_map), gradients, side * normal, surface.finish.relief);
  }
  point.normal = normal;
  point.reflectance = colour, point.transmittance = Vec3::Zero();
  if (!surface.leaf) return point;

  const SheetOptics optics = sheet_optics(colour, surface.finish.translucency);
  point.reflectance = upper ? optics.upper : optics.under, point.transmittance = optics.transmittance;
  if (!upper) point.gloss *= 0.4;  // the wax is on the upper side
  conserve(point);
  return point;
}

}  // namespace wilt
