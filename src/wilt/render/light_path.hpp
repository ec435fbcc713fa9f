// The light that reaches the eye along one ray.
#pragma once

#include <cstdint>
#include <optional>

#include "wilt/core/types.hpp"
#include "wilt/render/material.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/render/rays.hpp"
#include "wilt/render/sampling.hpp"

namespace wilt {

/// Follows paths of light backwards: sun at every point, one further ray from each, sky at the end.
///
/// The last ray of a path sees the sky even where something stands in its way, so that a scene that absorbs
/// nothing in a uniform sky is that sky for any number of bounces.
class LightPath {
 public:
  /// World and options must outlive this.
  LightPath(const World& world, const PictureOptions& options, double pixel_angle);

  /// Linear RGB radiance along `ray` (world units) towards its origin. A ray from the eye is as wide as a
  /// pixel.
  Vec3 radiance(Ray ray, Sampler& sampler) const;

 private:
  struct Bounce {
    Ray ray;
    Vec3 weight;  ///< reflected or transmitted share over the probability of the choice
  };

  std::optional<double> ground_distance(const Ray& ray) const;
  ShadingPoint ground_point(const Vec3& p, bool first) const;
  double ground_presence(const Vec3& p) const;
  Vec3 sunlight(const ShadingPoint& point, const Vec3& view, bool first, Sampler& sampler) const;
  std::optional<Bounce> next_bounce(const ShadingPoint& point, const Vec3& view, bool first,
                                    Sampler& sampler) const;

  const World& world_;
  const PictureOptions& options_;
  Vec3 sun_direction_;
  Frame3 sun_frame_;
  double pixel_angle_;          // radians
  double ground_height_ = 0.0;  // world units
  Vec3 background_, ground_albedo_;
};

}  // namespace wilt
