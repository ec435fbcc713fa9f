#include "wilt/output/coordinates.hpp"

#include <fmt/format.h>

namespace wilt {
namespace {

Eigen::Matrix3d y_up() {
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

}  // namespace

Points3 file_points(const Placement& placement, const Points3& points) {
  const Eigen::Matrix3d linear = y_up() * (placement.scale * placement.rotation);
  const Vec3 offset = y_up() * placement.translation;
  return (points * linear.transpose()).rowwise() + offset.transpose();
}

Points3 leaf_points(const Placement& placement, const Points3& points) {
  const Vec3 offset = y_up() * placement.translation;
  return (points.rowwise() - offset.transpose()) * (y_up() * placement.rotation) / placement.scale;
}

Points3 file_normals(const Placement& placement, const Points3& normals) {
  return (normals * (y_up() * placement.rotation).transpose()).rowwise().normalized();
}

double metres_per_unit(const Placement& placement) {
  return 1.0 / placement.scale;
}

std::string unit_name(const Placement& placement) {
  return placement.scale == 1.0 ? "metres" : fmt::format("{:.6g} metres", metres_per_unit(placement));
}

}  // namespace wilt
