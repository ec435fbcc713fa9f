// Where a picture is taken from.
#pragma once

#include "wilt/core/types.hpp"

namespace wilt {

/// A pinhole with a long lens.
struct Camera {
  Vec3 eye = {0.0, -1.0, 1.0};
  Vec3 forward = {0.0, 1.0, -1.0};  ///< need not be of unit length
  Vec3 up = {0.0, 0.0, 1.0};        ///< not parallel to forward
  double field_of_view = 0.25;      ///< of the picture's height, radians, in (0, 2)
};

/// The direction a picture is taken from.
struct View {
  double azimuth =
      -1.3089969389957472;  ///< of the camera about Z, radians; -pi/2 looks along +y, to the apex
  double elevation = 0.7853981633974483;  ///< above the horizon, radians, in [-pi/2, pi/2]
  double field_of_view = 0.25;            ///< of the picture's height, radians, in (0, 2)
  double margin = 0.09;                   ///< free on each side, as a share of the picture, in [0, 0.45]
};

/// The closest camera along `view` that sees every point (#P x 3, P >= 1) within the margin; exact.
/// `aspect` is width / height. Throws Error{input} without points, Error{configuration} for a wrong view.
Camera frame_camera(const Points3& points, double aspect, const View& view = {});

/// Orthonormal axes of a camera: right, up, forward.
struct CameraAxes {
  Vec3 right, up, forward;
};
CameraAxes camera_axes(const Camera& camera);

/// Where a point stands in the picture: x and y in [-1, 1] within the frame (y upwards), and its depth.
struct Projection {
  double x, y, depth;
};
Projection project(const Camera& camera, double aspect, const Vec3& point);

}  // namespace wilt
