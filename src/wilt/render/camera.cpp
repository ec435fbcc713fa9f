#include "wilt/render/camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

void check_view(const View& view) {
  const auto require = [](bool ok, const char* name, double value, const char* allowed) {
    if (!ok)
      throw Error(ErrorCode::configuration, fmt::format("view: {} is {}; allowed: {}", name, value, allowed));
  };
  require(std::isfinite(view.azimuth), "azimuth", view.azimuth, "any finite angle, radians");
  require(std::abs(view.elevation) <= std::numbers::pi / 2 + 1e-12, "elevation", view.elevation,
          "-pi/2 to pi/2, radians");
  require(view.field_of_view > 0.0 && view.field_of_view < 2.0, "field_of_view", view.field_of_view,
          "above 0 and below 2, radians");
  require(view.margin >= 0.0 && view.margin <= 0.45, "margin", view.margin, "0 to 0.45");
}

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  CameraAxes axes;
  axes.forward = camera.forward.normalized();
  axes.right = axes.forward.cross(camera.up).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

// In camera axes (x, y, z = right, up, forward) a point is in the frame of an eye e when
// |x - e_x| <= t_x (z - e_z), and alike for y, with t the tangent of half the angle less the margin.
// With A = max(x - t z) and B = min(-(x + t z)) negated that is A <= e_x - t e_z and e_x + t e_z <= B: the
// largest possible e_z is (B - A) / 2t, the smaller one of the two axes holds, and e_x = (A + B) / 2 centres.
Camera frame_camera(const Points3& points, double aspect, const View& view) {
  if (points.rows() == 0) throw Error(ErrorCode::input, "a camera cannot frame a scene without any point");
  check_view(view);
  const double ce = std::cos(view.elevation), se = std::sin(view.elevation);
  const double ca = std::cos(view.azimuth), sa = std::sin(view.azimuth);
  Camera camera;
  camera.forward = Vec3(-ce * ca, -ce * sa, -se);
  camera.up = Vec3(-se * ca, -se * sa, ce);
  camera.field_of_view = view.field_of_view;

  const CameraAxes axes = camera_axes(camera);
  const double tangent = std::tan(0.5 * view.field_of_view) * (1.0 - 2.0 * view.margin);
  const Eigen::VectorXd z = points * axes.forward;
  const auto fit = [&](const Vec3& axis, double t) {
    const Eigen::VectorXd x = points * axis;
    return std::pair((x - t * z).maxCoeff(), (x + t * z).minCoeff());
  };
  const auto [ax, bx] = fit(axes.right, tangent * aspect);
  const auto [ay, by] = fit(axes.up, tangent);
  const double extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  const double nearest = z.minCoeff() - 1e-3 * std::max(extent, 1e-9);  // a lone point: stay before it
  const double ez = std::min({(bx - ax) / (2.0 * tangent * aspect), (by - ay) / (2.0 * tangent), nearest});
  camera.eye = axes.right * (0.5 * (ax + bx)) + axes.up * (0.5 * (ay + by)) + axes.forward * ez;
  return camera;
}

Projection project(const Camera& camera, double aspect, const Vec3& point) {
  const CameraAxes axes = camera_axes(camera);
  const Vec3 d = point - camera.eye;
  const double depth = d.dot(axes.forward);
  const double tangent = std::tan(0.5 * camera.field_of_view);
  return {d.dot(axes.right) / (depth * tangent * aspect), d.dot(axes.up) / (depth * tangent), depth};
}

}  // namespace wilt
