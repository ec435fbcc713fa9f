#include "wilt/render/leaf_scene.hpp"

#include <Eigen/Geometry>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

constexpr double kVeinRadius[] = {0.0045, 0.0020};  // of the first two orders at the base, in leaf lengths

Vec3 area_vector(const Points3& positions, const Faces& faces) {
  Vec3 sum = Vec3::Zero();
  for (int f = 0; f < faces.rows(); ++f) {
    const Vec3 a = positions.row(faces(f, 0)).transpose();
    const Vec3 ab = positions.row(faces(f, 1)).transpose() - a,
               ac = positions.row(faces(f, 2)).transpose() - a;
    sum += 0.5 * ab.cross(ac);
  }
  return sum;
}

Vec3 on_face(const Points3& positions, const Faces& faces, int face, const Vec3& barycentric) {
  Vec3 point = Vec3::Zero();
  for (int i = 0; i < 3; ++i) point += barycentric[i] * positions.row(faces(face, i)).transpose();
  return point;
}

// Where the veins leave the stalk; the middle of the blade for a leaf without veins.
Vec3 blade_base(const GlbFile& file, const Points3& positions) {
  if (file.veins.empty() || file.veins.front().faces.empty()) return positions.colwise().mean().transpose();
  const GlbVein& vein = file.veins.front();
  return on_face(positions, file.meshes.front().faces, vein.faces.front(),
                 vein.barycentric.row(0).transpose());
}

/// Turns and moves the file's coordinates so that the leaf lies at the origin.
class Pose {
 public:
  Pose(const GlbFile& file, int frame) {
    const GlbMesh& blade = file.meshes.front();
    const Points3& positions = blade.frames[static_cast<std::size_t>(frame)];
    base_ = blade_base(file, positions);
    const Vec3 up = area_vector(positions, blade.faces).normalized();
    const Vec3 middle = positions.colwise().mean().transpose();
    Vec3 apex = middle - base_ - up * up.dot(middle - base_);
    if (apex.squaredNorm() < 1e-18) apex = up.unitOrthogonal();
    apex.normalize();
    turn_.col(0) = apex.cross(up);
    turn_.col(1) = apex;
    turn_.col(2) = up;
  }

  Points3 points(const Points3& of_file) const { return (of_file.rowwise() - base_.transpose()) * turn_; }
  Points3 normals(const Points3& of_file) const { return of_file * turn_; }

 private:
  Vec3 base_;
  Eigen::Matrix3d turn_;  // its columns are the picture's axes in the file's
};

Surface surface(const GlbMesh& mesh, int frame, const Pose& pose) {
  const auto at = [frame](const std::vector<Points3>& frames) -> const Points3& {
    return frames[frames.size() == 1 ? 0 : static_cast<std::size_t>(frame)];
  };
  Surface result;
  result.positions = pose.points(at(mesh.frames));
  result.normals = pose.normals(at(mesh.normals));
  result.faces = mesh.faces;
  result.colours = mesh.colours.empty() ? Points3::Ones(result.positions.rows(), 3) : at(mesh.colours);
  return result;
}

VeinLine vein_line(const GlbVein& vein, const Surface& blade, double length) {
  VeinLine line;
  line.order = vein.order;
  line.radius = kVeinRadius[vein.order == 1 ? 0 : 1] * length;
  line.positions.resize(static_cast<int>(vein.faces.size()), 3);
  for (int i = 0; i < line.positions.rows(); ++i)
    line.positions.row(i) = on_face(blade.positions, blade.faces, vein.faces[static_cast<std::size_t>(i)],
                                    vein.barycentric.row(i).transpose())
                                .transpose();
  return line;
}

}  // namespace

Scene leaf_scene(const GlbFile& file, int frame) {
  WILT_CHECK(frame >= 0 && frame < static_cast<int>(file.times.size()), frame, file.times.size());
  const Pose pose(file, frame);
  const Points3 rest = Pose(file, 0).points(file.meshes.front().frames.front());
  const double length = rest.rowwise().norm().maxCoeff();
  Scene scene;
  for (const GlbMesh& mesh : file.meshes) {
    scene.surfaces.push_back(surface(mesh, frame, pose));
    scene.surfaces.back().leaf = mesh.name == "blade";
  }
  Surface& blade = scene.surfaces.front();
  blade.uv = rest.leftCols<2>() / length;
  for (const GlbVein& vein : file.veins) {
    if (vein.faces.size() >= 2) scene.veins.push_back(vein_line(vein, blade, length));
  }
  return scene;
}

}  // namespace wilt
