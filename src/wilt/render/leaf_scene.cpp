#include "wilt/render/leaf_scene.hpp"

#include <cmath>

#include "wilt/core/check.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/stack_rows.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/tube.hpp"
#include "wilt/render/refine.hpp"
#include "wilt/render/resting_pose.hpp"
#include "wilt/render/texture.hpp"

namespace wilt {
namespace {

constexpr int kRefinedFaces = 60000;  // refine while the result has no more
constexpr int kMaxLevels = 2;
constexpr double kRimRadius = 0.0009;  // in leaf lengths
constexpr double kRimShade = 0.85;     // of the blade's colour
constexpr int kRimSides = 5;
constexpr double kFreshRelief = 0.3;  // of the relief of the dry leaf
constexpr int kBlendedFrames = 2;     // on either side

// Where the veins leave the stalk; the first vertex of a leaf without veins.
Vec3 blade_base(const GlbFile& file, const Points3& positions) {
  if (file.veins.empty() || file.veins.front().faces.empty()) return positions.row(0).transpose();
  const GlbVein& vein = file.veins.front();
  const auto corners = file.meshes.front().faces.row(vein.faces.front());
  Vec3 base = Vec3::Zero();
  for (int i = 0; i < 3; ++i) base += vein.barycentric(0, i) * positions.row(corners[i]).transpose();
  return base;
}

// From the file's axes to the table's: mean normal up, base to middle along +y.
Eigen::Matrix3d laid_down(const GlbFile& file, const Points3& positions) {
  const Vec3 up = area_vector(file.meshes.front().faces, positions).normalized();
  const Vec3 way = positions.colwise().mean().transpose() - blade_base(file, positions);
  Vec3 apex = way - up * up.dot(way);
  if (apex.squaredNorm() < 1e-18) apex = up.unitOrthogonal();
  Eigen::Matrix3d turn;
  turn.row(1) = apex.normalized();
  turn.row(2) = up;
  turn.row(0) = turn.row(1).cross(turn.row(2));
  return turn;
}

Eigen::Quaterniond resting(const GlbFile& file, std::size_t frame) {
  const Points3& blade = file.meshes.front().frames[frame];
  const Eigen::Matrix3d laid = laid_down(file, blade);
  std::vector<Points3> parts;
  for (const GlbMesh& mesh : file.meshes) parts.push_back(mesh.frames[frame] * laid.transpose());
  const Vec3 centre = laid * blade.colwise().mean().transpose();
  return Eigen::Quaterniond(resting_rotation(stack_rows(parts), centre) * laid);
}

Eigen::Quaterniond blended(const std::vector<Eigen::Quaterniond>& turns, int frame) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  const Eigen::Vector4d here = turns[std::size_t(frame)].coeffs();
  for (int d = -kBlendedFrames; d <= kBlendedFrames; ++d) {
    const int k = frame + d;
    if (k < 0 || k >= static_cast<int>(turns.size())) continue;
    const Eigen::Vector4d there = turns[std::size_t(k)].coeffs();
    sum += std::exp(-0.5 * d * d) * (there.dot(here) < 0.0 ? -1.0 : 1.0) * there;
  }
  return Eigen::Quaterniond(Eigen::Vector4d(sum.normalized()));
}

Points3 between(const std::vector<Points3>& frames, double frame) {
  if (frames.size() == 1) return frames.front();
  const auto k = std::min(static_cast<std::size_t>(frame), frames.size() - 2);
  const double t = frame - double(k);
  return (1.0 - t) * frames[k] + t * frames[k + 1];
}

}  // namespace

LeafScene::LeafScene(const GlbFile& file) : file_(file) {
  std::vector<Eigen::Quaterniond> rests;
  for (std::size_t k = 0; k < file.times.size(); ++k) rests.push_back(resting(file, k));
  for (int k = 0; k < static_cast<int>(rests.size()); ++k) turns_.push_back(blended(rests, k));
  const Points3& rest = file.meshes.front().frames.front();
  length_ = (rest.rowwise() - blade_base(file, rest).transpose()).rowwise().norm().maxCoeff();
  if (!file.texture.empty()) colour_map_ = decode_image(file.texture);
  if (!file.normal_texture.empty()) normal_map_ = decode_image(file.normal_texture);
}

Surface LeafScene::surface(const GlbMesh& mesh, double frame) const {
  const auto k = std::min(static_cast<std::size_t>(frame), turns_.size() - 1);
  const auto next = std::min(k + 1, turns_.size() - 1);
  const Eigen::Matrix3d turn = turns_[k].slerp(frame - double(k), turns_[next]).toRotationMatrix();
  const Vec3 base = blade_base(file_, between(file_.meshes.front().frames, frame));
  Surface result;
  result.positions = (between(mesh.frames, frame).rowwise() - base.transpose()) * turn.transpose();
  result.normals = between(mesh.normals, frame) * turn.transpose();
  result.faces = mesh.faces;
  if (mesh.colours.empty()) {
    result.colours = Points3::Ones(result.positions.rows(), 3);
  } else {
    result.colours = between(mesh.colours, frame).cwiseMax(0.0).cwiseMin(1.0);
  }
  return result;
}

// The normal map is of the last frame; a leaf that is still fresh is smoother.
double LeafScene::relief(double frame) const {
  const auto k = std::min(static_cast<std::size_t>(frame), file_.dryness.size() - 1);
  const auto next = std::min(k + 1, file_.dryness.size() - 1);
  const double dryness = file_.dryness[k] + (frame - double(k)) * (file_.dryness[next] - file_.dryness[k]);
  const double last = file_.dryness.back();
  return last > 0.0 ? kFreshRelief + (1.0 - kFreshRelief) * std::clamp(dryness / last, 0.0, 1.0) : 1.0;
}

// A thin tube along the margin, in the colour of the blade beside it but darker.
Surface LeafScene::rim(const Surface& blade) const {
  const Texture colour_map(blade.colour_map, Texture::Kind::colour);
  Surface rim;
  rim.leaf = false;
  rim.finish.gloss = 0.15;
  for (std::vector<int> loop : margin_loops(blade.positions, blade.faces)) {
    loop.push_back(loop.front());
    const int count = static_cast<int>(loop.size());
    Points3 line(count, 3), colours(count, 3);
    for (int i = 0; i < count; ++i) {
      const int v = loop[std::size_t(i)];
      line.row(i) = blade.positions.row(v);
      colours.row(i) = kRimShade * blade.colours.row(v);
      if (!colour_map.empty())
        colours.row(i) =
            colours.row(i).cwiseProduct(colour_map.at(blade.uv.row(v).transpose(), 0.0).transpose());
    }
    const Tube shape = tube(line, std::vector<double>(std::size_t(count), kRimRadius * length_), kRimSides,
                            tube_reference(line));
    const auto first = static_cast<int>(rim.positions.rows());
    const auto extend = [first](auto& all, const auto& part) {
      all.conservativeResize(first + part.rows(), part.cols());
      all.bottomRows(part.rows()) = part;
    };
    std::vector<int> ring, vertex;  // of each corner: its place in the line, its vertex of the blade
    for (int i = 0; i < shape.positions.rows(); ++i) {
      ring.push_back(std::min(i / kRimSides, count - 1));
      vertex.push_back(loop[std::size_t(ring.back())]);
    }
    extend(rim.positions, shape.positions);
    extend(rim.normals, shape.normals);
    extend(rim.colours, Points3(colours(ring, Eigen::all)));
    extend(rim.rest, Points3(blade.rest(vertex, Eigen::all)));
    if (blade.water.size() > 0) extend(rim.water, Eigen::VectorXd(blade.water(vertex)));
    const Eigen::Index faces = rim.faces.rows();
    rim.faces.conservativeResize(faces + shape.faces.rows(), 3);
    rim.faces.bottomRows(shape.faces.rows()) = shape.faces.array() + first;
  }
  return rim;
}

Scene LeafScene::at(double frame, const Eigen::VectorXd& water) const {
  WILT_CHECK(frame >= 0.0 && frame <= frames() - 1.0, frame, frames());
  const Points3& rest = file_.meshes.front().frames.front();
  WILT_CHECK(water.size() == 0 || water.size() == rest.rows(), water.size(), rest.rows());
  Scene scene;
  for (const GlbMesh& mesh : file_.meshes) scene.surfaces.push_back(surface(mesh, frame));
  for (Surface& solid : scene.surfaces) solid.leaf = false, solid.part = Part::stalk;
  Surface& blade = scene.surfaces.front();
  blade.leaf = true, blade.part = Part::blade;
  blade.rest = rest, blade.water = water;
  blade.uv = file_.meshes.front().uv;
  if (blade.uv.rows() > 0) blade.colour_map = colour_map_, blade.normal_map = normal_map_;
  blade.finish.relief = relief(frame);
  int levels = 0;
  while (levels < kMaxLevels && (blade.faces.rows() << (2 * (levels + 1))) <= kRefinedFaces) ++levels;
  refine(blade, levels);
  if (Surface edge = rim(blade); edge.faces.rows() > 0) scene.surfaces.push_back(std::move(edge));
  double lowest = 0.0;
  for (const Surface& part : scene.surfaces) {
    if (part.positions.rows() > 0) lowest = std::min(lowest, part.positions.col(2).minCoeff());
  }
  for (Surface& part : scene.surfaces) part.positions.col(2).array() -= lowest;
  return scene;
}

Scene leaf_scene(const GlbFile& file, double frame) {
  return LeafScene(file).at(frame);
}

}  // namespace wilt
