// The coat is GGX with Schlick's Fresnel term and height-correlated Smith shadowing (B. Walter et al.,
// "Microfacet Models for Refraction through Rough Surfaces", 2007; E. Heitz, JCGT 2014):
//   F = F0 + (1 - F0) (1 - cos)^5, D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2), G2 from Lambda
#include "wilt/render/light_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/smooth_step.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/render/sampling.hpp"
#include "wilt/render/tone.hpp"

namespace wilt {
namespace {

constexpr double kNormalReflectance = 0.04;               // F0 of wax, index 1.5
constexpr double kScatteredAngle = 0.02;                  // radians: width of a ray between surfaces
constexpr double kGroundInner = 2.5, kGroundOuter = 6.0;  // world units: where the ground fades

double fresnel(double cosine) {
  const double m = 1.0 - std::clamp(cosine, 0.0, 1.0);
  return kNormalReflectance + (1.0 - kNormalReflectance) * m * m * m * m * m;
}

double smith_lambda(double cosine, double alpha) {
  const double tangent2 = 1.0 / (cosine * cosine) - 1.0;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * std::max(tangent2, 0.0)) - 1.0);
}

// D G2 F / (4 n.v), the factor n.l included.
double coat_reflection(const Vec3& n, const Vec3& view, const Vec3& light, double alpha) {
  const double nl = n.dot(light), nv = std::max(n.dot(view), 1e-3);
  if (nl <= 0.0) return 0.0;
  const Vec3 h = (view + light).normalized();
  const double nh = n.dot(h), a2 = alpha * alpha, q = nh * nh * (a2 - 1.0) + 1.0;
  const double d = a2 / (std::numbers::pi * q * q);
  const double g = 1.0 / (1.0 + smith_lambda(nl, alpha) + smith_lambda(nv, alpha));
  return d * g * fresnel(view.dot(h)) / (4.0 * nv);
}

// What the coat takes away from the light that goes in and out of the tissue.
double coat_share(const ShadingPoint& point, const Vec3& view, bool first) {
  return first && point.gloss > 0.0 ? point.gloss * fresnel(point.normal.dot(view)) : 0.0;
}

}  // namespace

LightPath::LightPath(const World& world, const PictureOptions& options, double pixel_angle)
    : world_(world),
      options_(options),
      sun_direction_(options.lighting.sun.direction.normalized()),
      sun_frame_(sun_direction_),
      pixel_angle_(pixel_angle),
      background_(radiance_of(options.background) / options.exposure) {
  double lowest = 1e300;
  for (const Surface& surface : world.scene().surfaces)
    if (surface.positions.rows() > 0) lowest = std::min(lowest, surface.positions.col(2).minCoeff());
  ground_height_ = lowest - 1e-3;
  if (options.ground_height) ground_height_ = world.to_world(Vec3(0.0, 0.0, *options.ground_height)).z();
  // Lit by the whole sky and the sun, the ground has the background's colour.
  const Sun& sun = options.lighting.sun;
  const Vec3 white = options.lighting.sky.mean_above() +
                     sun.irradiance * (std::max(sun_direction_.z(), 0.0) / std::numbers::pi);
  ground_albedo_ = background_.cwiseQuotient(white.cwiseMax(1e-9));
}

std::optional<double> LightPath::ground_distance(const Ray& ray) const {
  if (!options_.ground || ray.direction.z() >= 0.0 || ray.origin.z() <= ground_height_) return std::nullopt;
  return (ground_height_ - ray.origin.z()) / ray.direction.z();
}

ShadingPoint LightPath::ground_point(const Vec3& p, bool first) const {
  ShadingPoint point;
  point.normal = Vec3::UnitZ();
  point.front = point.back = p + Vec3(0.0, 0.0, 1e-4);
  // A background brighter than the light allows would let light grow from bounce to bounce.
  point.reflectance = first ? ground_albedo_ : ground_albedo_.cwiseMin(0.9).eval();
  point.transmittance = Vec3::Zero();
  return point;
}

double LightPath::ground_presence(const Vec3& p) const {
  return 1.0 - smooth_step(kGroundInner, kGroundOuter, p.head<2>().norm());
}

Vec3 LightPath::sunlight(const ShadingPoint& point, const Vec3& view, bool first, Sampler& sampler) const {
  const Sun& sun = options_.lighting.sun;
  const Vec2 u = sampler.next();
  const double cosine = point.normal.dot(sun_direction_);
  const bool in_front = cosine > 0.0;
  const Vec3& tissue = in_front ? point.reflectance : point.transmittance;
  if (tissue.isZero() && !(in_front && point.gloss > 0.0)) return Vec3::Zero();

  const Vec3 towards = sun_frame_.to_world(sample_cap(u, sun.radius));
  if (world_.blocked({in_front ? point.front : point.back, towards})) return Vec3::Zero();
  Vec3 reflected = (1.0 - coat_share(point, view, first)) * std::abs(cosine) / std::numbers::pi * tissue;
  if (in_front && first && point.gloss > 0.0) {
    const double coat = point.gloss * coat_reflection(point.normal, view, sun_direction_, point.roughness);
    reflected += Vec3::Constant(coat);
  }
  return reflected.cwiseProduct(sun.irradiance);
}

std::optional<LightPath::Bounce> LightPath::next_bounce(const ShadingPoint& point, const Vec3& view,
                                                        bool first, Sampler& sampler) const {
  Vec2 u = sampler.next();
  const Frame3 frame(point.normal);
  const double share = coat_share(point, view, first);
  // Grazing reflections are bright and few: at least a tenth of the rays go to the coat.
  const double p_coat = share > 0.0 ? std::clamp(share, 0.1, 0.5) : 0.0;
  // u.x chooses the lobe and is stretched afterwards, so that the points stay well spread within each.
  if (u.x() < p_coat) {
    u.x() /= p_coat;
    const Vec3 local(view.dot(frame.s), view.dot(frame.t), std::max(view.dot(frame.n), 1e-3));
    const Vec3 h = frame.to_world(sample_visible_normal(u, local.normalized(), point.roughness));
    const Vec3 direction = (2.0 * h.dot(view) * h - view).normalized();
    const double nl = direction.dot(point.normal);
    if (nl <= 0.0) return std::nullopt;
    const double lambda_v = smith_lambda(local.z(), point.roughness),
                 lambda_l = smith_lambda(nl, point.roughness);
    const double weight = fresnel(h.dot(view)) * (1.0 + lambda_v) / (1.0 + lambda_v + lambda_l);
    return Bounce{{point.front, direction}, Vec3::Constant(point.gloss * weight / p_coat)};
  }
  const double r = luminance(point.reflectance), t = luminance(point.transmittance);
  if (r + t <= 0.0) return std::nullopt;
  u.x() = (u.x() - p_coat) / (1.0 - p_coat);
  const double p_reflect = r / (r + t), passed = (1.0 - share) / (1.0 - p_coat);
  const bool reflected = u.x() < p_reflect;
  const double chance = reflected ? p_reflect : 1.0 - p_reflect;
  u.x() = reflected ? u.x() / chance : (u.x() - p_reflect) / chance;
  const Vec3 direction = frame.to_world(sample_cosine(u));
  if (reflected) return Bounce{{point.front, direction}, passed / chance * point.reflectance};
  return Bounce{{point.back, -direction}, passed / chance * point.transmittance};
}

Vec3 LightPath::radiance(Ray ray, Sampler& sampler) const {
  const Sky& sky = options_.lighting.sky;
  Vec3 light = Vec3::Zero(), weight = Vec3::Ones();
  for (int bounce = 0; bounce < options_.bounces; ++bounce) {
    const bool first = bounce == 0;
    const std::optional<Hit> hit = world_.first_hit(ray);
    const std::optional<double> ground = ground_distance(ray);
    const bool on_ground = ground && (!hit || *ground < hit->distance);
    if (!on_ground && !hit)
      return light + weight.cwiseProduct(first ? background_ : sky.radiance(ray.direction));

    ShadingPoint point;
    if (on_ground) {
      const Vec3 p = ray.origin + *ground * ray.direction;
      const double presence = first ? ground_presence(p) : 1.0;
      if (presence <= 0.0) return background_;
      if (first) light = (1.0 - presence) * background_, weight *= presence;
      point = ground_point(p, first);
    } else {
      point = shading_point(world_, ray, *hit, hit->distance * (first ? pixel_angle_ : kScatteredAngle));
    }
    const Vec3 view = -ray.direction;
    light += weight.cwiseProduct(sunlight(point, view, first, sampler));
    const std::optional<Bounce> next = next_bounce(point, view, first, sampler);
    if (!next) return light;
    weight = weight.cwiseProduct(next->weight);
    // The open sky over a level ground is known: only what stands before it is left to chance.
    if (on_ground) light += weight.cwiseProduct(sky.mean_above() - sky.radiance(next->ray.direction));
    ray = next->ray;
  }
  return light + weight.cwiseProduct(sky.radiance(ray.direction));
}

}  // namespace wilt
