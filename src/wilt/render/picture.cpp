#include "wilt/render/picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/render/lens.hpp"
#include "wilt/render/light_path.hpp"
#include "wilt/render/tone.hpp"

namespace wilt {
namespace {

constexpr int kTile = 16;   // pixels
constexpr int kRound = 16;  // samples

void require(bool ok, const char* name, double value, const char* allowed) {
  if (!ok)
    throw Error(ErrorCode::configuration,
                fmt::format("picture: {} is {}; allowed: {}", name, value, allowed));
}

// A tent as wide as 1.5 pixels: crisp, and softer on edges than a box.
double tent(double u) {
  constexpr double kHalfWidth = 0.75;
  return kHalfWidth * (u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u));
}

// Rounds of kRound samples, until the mean is known well enough or `options.samples` are spent.
Vec3 pixel_radiance(const LightPath& path, const Lens& lens, const PictureOptions& options, int x, int y) {
  const std::uint64_t hash = mix_hash(mix_hash(options.seed, std::uint64_t(x)), std::uint64_t(y));
  Vec3 sum = Vec3::Zero();
  double brightness = 0.0, squares = 0.0;
  for (int done = 0; done < options.samples;) {
    const int count = std::min(kRound, options.samples - done);
    for (int i = 0; i < count; ++i) {
      Sampler sampler(mix_hash(hash, std::uint64_t(done)), std::uint32_t(i), std::uint32_t(count));
      const Vec2 u = sampler.next();
      const Vec3 light = path.radiance(lens.ray(x + 0.5 + tent(u.x()), y + 0.5 + tent(u.y())), sampler);
      sum += light;
      brightness += light.mean();
      squares += light.mean() * light.mean();
    }
    done += count;
    const double mean = brightness / done, variance = std::max(squares / done - mean * mean, 0.0);
    if (std::sqrt(variance / done) < options.noise * (mean + 0.1)) return sum / done;
  }
  return sum / options.samples;
}

}  // namespace

void PictureOptions::validate() const {
  require(width >= 1 && width <= 16384, "width", width, "1 to 16384 pixels");
  require(height >= 1 && height <= 16384, "height", height, "1 to 16384 pixels");
  require(samples >= 1 && samples <= 65536, "samples", samples, "1 to 65536 per pixel");
  require(noise >= 0.0 && noise <= 1.0, "noise", noise, "0 to 1");
  require(bounces >= 1 && bounces <= 16, "bounces", bounces, "1 to 16");
  require(exposure > 0.0 && std::isfinite(exposure), "exposure", exposure, "above 0");
  require(background.minCoeff() >= 0.0 && background.maxCoeff() <= 1.0, "background", background.maxCoeff(),
          "0 to 1 in each channel (sRGB)");
  const Sun& sun = lighting.sun;
  require(sun.direction.allFinite() && sun.direction.norm() > 0.0, "length of sun.direction",
          sun.direction.norm(), "above 0");
  require(sun.radius >= 0.0 && sun.radius <= 0.5, "sun.radius", sun.radius, "0 to 0.5 radians");
  require(sun.irradiance.minCoeff() >= 0.0, "sun.irradiance", sun.irradiance.minCoeff(), "0 or more");
  if (camera) {
    require(camera->field_of_view > 0.0 && camera->field_of_view < 2.0, "camera.field_of_view",
            camera->field_of_view, "above 0 and below 2 radians");
    const double sine = camera->forward.normalized().cross(camera->up.normalized()).norm();
    require(sine > 1e-9, "sine of the angle between camera.forward and camera.up", sine, "above 0");
  }
}

Radiance render_radiance(const Scene& scene, const PictureOptions& options, const Monitor& monitor) {
  validate(scene);
  options.validate();
  const World world(scene);
  const double aspect = double(options.width) / options.height;
  const Camera camera =
      options.camera ? *options.camera : frame_camera(scene_points(scene), aspect, options.view);
  const Lens lens(camera, world, options.width, options.height);
  const LightPath path(world, options, camera.field_of_view / options.height);

  Radiance picture{options.width, options.height, Points3(Eigen::Index(options.width) * options.height, 3)};
  const int columns = (options.width + kTile - 1) / kTile;
  for (int top = 0; top < options.height; top += kTile) {
    monitor.throw_if_cancelled();
    monitor.report("render", double(top) / options.height);
    const int bottom = std::min(top + kTile, options.height);
    parallel_for(columns, 1, [&](int begin, int end) {
      for (int y = top; y < bottom; ++y)
        for (int x = begin * kTile; x < std::min(end * kTile, options.width); ++x)
          picture.rgb.row(Eigen::Index(y) * options.width + x) =
              pixel_radiance(path, lens, options, x, y).transpose();
    });
  }
  monitor.report("render", 1.0);
  return picture;
}

Image develop(const Radiance& radiance, double exposure) {
  require(exposure > 0.0 && std::isfinite(exposure), "exposure", exposure, "above 0");
  Image image{radiance.width, radiance.height, {}};
  image.rgb.resize(radiance.rgb.size());
  const double* values = radiance.rgb.data();
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(tone(exposure * values[i]))));
  return image;
}

Image render(const Scene& scene, const PictureOptions& options, const Monitor& monitor) {
  return develop(render_radiance(scene, options, monitor), options.exposure);
}

}  // namespace wilt
