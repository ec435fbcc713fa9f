// An offscreen picture of leaves: rays by Embree, shading of our own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"
#include "wilt/render/camera.hpp"
#include "wilt/render/scene.hpp"

namespace wilt {

struct PictureOptions {
  int width = 960, height = 720;  ///< pixels, 1 to 16384
  int samples = 64;               ///< per pixel at most, 1 to 65536; multiples of 16 are best
  double noise = 0.02;  ///< no more samples once a pixel's standard error is below noise (mean + 0.1), 0 to 1
  std::uint64_t seed = 1;                ///< of the samples
  int bounces = 3;                       ///< of light between surfaces, 1 to 16
  Vec3 background = {0.93, 0.92, 0.90};  ///< as shown: sRGB, 0 to 1; a lit ground has the same colour
  bool ground = true;                    ///< a plane that takes the shadows and fades into the background
  std::optional<double> ground_height;   ///< in the scene's unit; its lowest point when not given
  double exposure = 1.0;                 ///< factor on all light before the tone curve, > 0
  Lighting lighting;
  std::optional<Camera> camera;  ///< frame_camera(scene_points(scene), aspect, view) when not given
  View view;

  /// Throws Error{configuration} that names the first wrong option.
  void validate() const;
};

/// Linear light, not yet developed: rows from the top, #pixels x 3, linear RGB radiance.
struct Radiance {
  int width = 0, height = 0;
  Points3 rgb;
};

/// Traces the picture. Sun with soft shadow, sky, light between surfaces and through leaves.
///
/// Deterministic: the bytes depend on the scene and the options, not on the number of threads.
/// O(pixels * samples * bounces * log #F). Throws Error{input} for an empty or broken scene,
/// Error{configuration} for wrong options, Error{interrupted} when the monitor says so.
Radiance render_radiance(const Scene& scene, const PictureOptions& options = {}, const Monitor& monitor = {});

/// From light to a picture: exposure, filmic tone curve, sRGB, 8 bits.
Image develop(const Radiance& radiance, double exposure = 1.0);

/// develop(render_radiance(...)).
Image render(const Scene& scene, const PictureOptions& options = {}, const Monitor& monitor = {});

}  // namespace wilt
