// The rays of a camera, pixel by pixel.
#pragma once

#include <cmath>

#include "wilt/render/camera.hpp"
#include "wilt/render/rays.hpp"

namespace wilt {

/// The camera's rays in world units; the middle of pixel (x, y) from the top left is at x + 1/2, y + 1/2.
class Lens {
 public:
  Lens(const Camera& camera, const World& world, int width, int height)
      : axes_(camera_axes(camera)), eye_(world.to_world(camera.eye)), width_(width), height_(height) {
    tangent_ = std::tan(0.5 * camera.field_of_view);
  }

  Ray ray(double px, double py) const {  // pixels from the top left corner
    const double step = 2.0 * tangent_ / height_;
    const Vec3 direction =
        axes_.forward + (px - 0.5 * width_) * step * axes_.right - (py - 0.5 * height_) * step * axes_.up;
    return {eye_, direction.normalized()};
  }

 private:
  CameraAxes axes_;
  Vec3 eye_;
  double tangent_ = 0.0;
  int width_, height_;
};

}  // namespace wilt
