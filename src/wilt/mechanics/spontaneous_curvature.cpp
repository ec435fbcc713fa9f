// Symbols: K curvature tensor, t and n unit vectors along and across the edge, l its length, h a triangle's
// height over it, foot where that height stands.
#include "wilt/mechanics/spontaneous_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

constexpr double kLargestAngle = 0.5 * std::numbers::pi;
constexpr double kFlattest = 1e-6;  // height / edge below which a triangle has no area

// A triangle over its edge: where its apex stands, and which way it lies.
struct Side {
  double foot, height;
  Vec3 across;

  Side(const Vec3& from, const Vec3& along, const Vec3& apex)
      : foot((apex - from).dot(along)), across((apex - from) - foot * along) {
    height = across.norm();
    if (height > 0.0) across /= height;
  }
  double bulge(double length) const { return foot * (foot - length) / height; }
};

// A hinge at rest with its frame.
struct Frame {
  double length;
  Vec3 along;
  Side left, right;

  Frame(const Points3& x, const Stencil& hinges, int hinge)
      : length((point(x, hinges(hinge, 1)) - point(x, hinges(hinge, 0))).norm()),
        along((point(x, hinges(hinge, 1)) - point(x, hinges(hinge, 0))) / length),
        left(point(x, hinges(hinge, 0)), along, point(x, hinges(hinge, 2))),
        right(point(x, hinges(hinge, 0)), along, point(x, hinges(hinge, 3))) {}

  bool flat_triangle() const { return !(std::min(left.height, right.height) > kFlattest * length); }
  Vec3 across() const { return (left.across - right.across).normalized(); }

 private:
  static Vec3 point(const Points3& x, int v) { return x.row(v).transpose(); }
};

// fill(hinge's frame, mean tensor of its edge's ends) for every hinge; 0 where a triangle has no area.
template <class Fill>
Eigen::VectorXd on_hinges(const Stencil& hinges, const Points3& rest,
                          const std::vector<Eigen::Matrix3d>& tensors, const Fill& fill) {
  detail::require_count("tensors", static_cast<Eigen::Index>(tensors.size()), rest.rows());
  Eigen::VectorXd values = Eigen::VectorXd::Zero(hinges.rows());
  for (int hinge = 0; hinge < hinges.rows(); ++hinge) {
    const Frame frame(rest, hinges, hinge);
    if (frame.flat_triangle()) continue;
    const Eigen::Matrix3d mean = 0.5 * (tensors[hinges(hinge, 0)] + tensors[hinges(hinge, 1)]);
    values[hinge] = fill(frame, mean);
  }
  return values;
}

}  // namespace

Eigen::VectorXd curvature_angles(const Stencil& hinges, const Points3& rest,
                                 const std::vector<Eigen::Matrix3d>& curvature) {
  return on_hinges(hinges, rest, curvature, [](const Frame& frame, const Eigen::Matrix3d& k) {
    const Vec3 t = frame.along, n = frame.across();
    const double jump =
        0.5 * n.dot(k * n) * (frame.left.height + frame.right.height) +
        t.dot(k * n) * (frame.left.foot - frame.right.foot) +
        0.5 * t.dot(k * t) * (frame.left.bulge(frame.length) + frame.right.bulge(frame.length));
    return -std::clamp(jump, -kLargestAngle, kLargestAngle);
  });
}

Eigen::VectorXd across_hinges(const Stencil& hinges, const Points3& rest,
                              const std::vector<Eigen::Matrix3d>& tensors) {
  return on_hinges(hinges, rest, tensors, [](const Frame& frame, const Eigen::Matrix3d& tensor) {
    const Vec3 n = frame.across();
    return n.dot(tensor * n);
  });
}

}  // namespace wilt
