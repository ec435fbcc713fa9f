#include "wilt/render/material.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wilt/render/detail.hpp"

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

// The plane that carries the fine detail, and its two surface gradients scaled to about unit length.
struct DetailChart {
  Vec2 p;
  Vec3 du, dv;
};

DetailChart detail_chart(const Surface& surface, const Hit& hit, const Corners& c) {
  const auto coordinate = [&](int i) -> Vec2 {
    if (surface.uv.rows() > 0) return surface.uv.row(surface.faces(hit.face, i)).transpose();
    return 0.5 * c.position[i].head<2>();
  };
  const Vec2 a = coordinate(0), ab = coordinate(1) - a, ac = coordinate(2) - a;
  const Vec3 u = c.position[1] - c.position[0], v = c.position[2] - c.position[0];
  const Vec3 n = u.cross(v);
  DetailChart chart{a + hit.weights[1] * ab + hit.weights[2] * ac, Vec3::Zero(), Vec3::Zero()};
  const double area2 = n.squaredNorm();
  if (area2 <= 0.0) return chart;
  const Vec3 gradient_b = v.cross(n) / area2, gradient_c = n.cross(u) / area2;  // of the weights
  chart.du = ab.x() * gradient_b + ac.x() * gradient_c;
  chart.dv = ab.y() * gradient_b + ac.y() * gradient_c;
  const double size = std::sqrt(0.5 * (chart.du.squaredNorm() + chart.dv.squaredNorm()));
  if (size > 0.0) chart.du /= size, chart.dv /= size;
  return chart;
}

// A vein is a ridge on both sides, pale and hardly translucent. Profile: (1 - (d / reach r)^2)^2.
void add_vein(ShadingPoint& point, const World& world, const Vec3& p, Vec3& slope) {
  constexpr double kReach = 2.4, kHeight = 1.1;  // in radii
  const auto vein = world.nearest_vein(p, kReach);
  if (!vein) return;
  const double x = vein->distance / (kReach * vein->radius), ridge = (1.0 - x * x) * (1.0 - x * x);
  slope -= (kHeight / kReach * 4.0 * x * (1.0 - x * x)) * vein->away;
  const VeinLine& line = world.scene().veins[vein->vein];
  const double cover = 0.62 * smooth_step(0.15, 0.9, ridge);
  point.reflectance += cover * (line.colour - point.reflectance);
  point.transmittance *= 1.0 - 0.6 * cover;
}

void add_fine_detail(ShadingPoint& point, const DetailChart& chart, double strength, std::uint64_t seed,
                     Vec3& slope) {
  const FineDetail detail = fine_detail(chart.p, seed);
  slope += strength * (detail.slope.x() * chart.du + detail.slope.y() * chart.dv);
  const double tone = 1.0 + strength * 0.16 * detail.tone;
  point.reflectance *= tone * (1.0 - strength * 0.14 * detail.vein);
  point.transmittance *= tone * (1.0 - strength * 0.38 * detail.vein);
}

// Keeps what is reflected plus what is transmitted within the light that arrives.
void conserve(ShadingPoint& point) {
  for (int i = 0; i < 3; ++i) {
    const double sum = point.reflectance[i] + point.transmittance[i];
    if (sum > 1.0) point.reflectance[i] /= sum, point.transmittance[i] /= sum;
  }
}

}  // namespace

LeafOptics leaf_optics(const Vec3& upper_colour, double translucency) {
  const double brightest = std::max(upper_colour.maxCoeff(), 1e-6);
  const double grey = upper_colour.dot(Vec3(0.2126, 0.7152, 0.0722));
  const Vec3 saturation = (upper_colour / brightest).cwiseSqrt();
  LeafOptics optics;
  optics.upper = upper_colour;
  // Half-way to a grey between its own and its brightest channel.
  optics.under = upper_colour + 0.45 * (Vec3::Constant(0.5 * (grey + brightest)) - upper_colour);
  optics.transmittance = translucency * upper_colour.cwiseProduct(saturation);
  return optics;
}

ShadingPoint shading_point(const World& world, const Ray& ray, const Hit& hit, bool fine,
                           std::uint64_t seed) {
  const Surface& surface = world.scene().surfaces[hit.surface];
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
  const Vec3 colour = interpolate(surface.colours, surface, hit);
  Vec3 normal = (side * interpolate(surface.normals, surface, hit)).normalized();
  if (normal.dot(geometric) < 0.0) normal = geometric;
  if (!surface.leaf) {
    point.normal = normal;
    point.reflectance = colour, point.transmittance = Vec3::Zero();
    return point;
  }

  const LeafOptics optics = leaf_optics(colour, surface.finish.translucency);
  point.reflectance = upper ? optics.upper : optics.under, point.transmittance = optics.transmittance;
  if (!upper) point.gloss *= 0.4;  // the wax is on the upper side
  if (fine) {
    Vec3 slope = Vec3::Zero();
    if (surface.finish.detail > 0.0)
      add_fine_detail(point, detail_chart(surface, hit, c), surface.finish.detail, seed, slope);
    add_vein(point, world, p, slope);
    slope -= normal * slope.dot(normal);
    normal = (normal - slope).normalized();
  }
  point.normal = normal;
  conserve(point);
  return point;
}

}  // namespace wilt
