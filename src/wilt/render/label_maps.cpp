#include "wilt/render/label_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/render/lens.hpp"
#include "wilt/render/picture.hpp"

namespace wilt {
namespace {

constexpr double kVeinWidth = 0.008;  // in roots of the blade's area
constexpr int kRows = 16;             // between two looks at the monitor
// How far before a keypoint the leaf may stand without hiding it, in world units: the stalk and the rim are
// as thick as that around the blade's base and tips.
constexpr double kSkin = 0.02;

double metres_per_unit(const GlbFile& file) {
  const auto extras = nlohmann::json::parse(file.extras, nullptr, false);
  const auto found = extras.is_object() ? extras.find("metres_per_unit") : extras.end();
  const double metres = found != extras.end() && found->is_number() ? found->get<double>() : 0.0;
  if (!(metres > 0.0 && std::isfinite(metres)))
    throw Error(ErrorCode::input,
                "the result does not say how many metres its unit has; give a .glb that wilt wrote");
  return metres;
}

double vein_width(const GlbFile& file, const LabelOptions& options, double metres) {
  options.validate();
  if (options.vein_width > 0.0) return options.vein_width / metres;
  const GlbMesh& blade = file.meshes.front();
  double area = 0.0;
  for (int f = 0; f < blade.faces.rows(); ++f)
    area += area_vector(blade.faces.row(f), blade.frames.front()).norm();
  return kVeinWidth * std::sqrt(std::max(area, std::numeric_limits<double>::min()));
}

// Maps are for light only, and take a while to prepare.
Scene without_maps(Scene scene) {
  for (Surface& surface : scene.surfaces) surface.colour_map = surface.normal_map = {};
  return scene;
}

template <class Rows>
auto interpolated(const Rows& rows, const Surface& surface, const Hit& hit) {
  const auto corners = surface.faces.row(hit.face);
  return (hit.weights[0] * rows.row(corners[0]) + hit.weights[1] * rows.row(corners[1]) +
          hit.weights[2] * rows.row(corners[2]))
      .eval();
}

// Rows of the leaf's pixels and columns, first and last.
void measure(LabelMaps& maps) {
  int left = maps.width, right = -1, top = maps.height, bottom = -1;
  for (int y = 0, i = 0; y < maps.height; ++y) {
    for (int x = 0; x < maps.width; ++x, ++i) {
      if (maps.part[std::size_t(i)] == 0) continue;
      ++maps.area;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  if (maps.area > 0) maps.box = {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace

/// One picture's rays.
class LeafLabels::Painter {
 public:
  Painter(const Scene& scene, const Camera& camera, int width, int height)
      : world_(without_maps(scene)),
        camera_(camera),
        axes_(camera_axes(camera)),
        lens_(camera, world_, width, height),
        width_(width),
        height_(height) {}

  void paint(int x, int y, const VeinOrders& veins, double metres, LabelMaps& maps) const {
    const auto i = std::size_t(y) * std::size_t(width_) + std::size_t(x);
    const Ray ray = lens_.ray(x + 0.5, y + 0.5);
    const std::optional<Hit> hit = world_.first_hit(ray);
    if (!hit) return;
    const Surface& surface = world_.scene().surfaces[std::size_t(hit->surface)];
    maps.part[i] = static_cast<std::uint8_t>(surface.part);
    maps.depth[i] =
        static_cast<float>(hit->distance * ray.direction.dot(axes_.forward) * world_.scale() * metres);
    maps.normals.row(Eigen::Index(i)) = normal(surface, *hit, ray).cast<float>();
    if (surface.part != Part::blade) return;
    if (surface.rest.rows() > 0)
      maps.vein[i] =
          static_cast<std::uint8_t>(veins.at(interpolated(surface.rest, surface, *hit).transpose()));
    if (surface.water.size() > 0)
      maps.water[i] = static_cast<float>(interpolated(surface.water, surface, *hit)[0]);
  }

  Keypoint keypoint(const Vec3& point) const {
    const Projection seen = project(camera_, double(width_) / height_, point);
    Keypoint keypoint{0.5 * (1.0 + seen.x) * width_, 0.5 * (1.0 - seen.y) * height_};
    keypoint.inside = seen.depth > 0.0 && std::abs(seen.x) <= 1.0 && std::abs(seen.y) <= 1.0;
    const Vec3 eye = world_.to_world(camera_.eye), way = world_.to_world(point) - eye;
    const std::optional<Hit> hit = world_.first_hit({eye, way.normalized()});
    keypoint.visible = keypoint.inside && (!hit || hit->distance > way.norm() - kSkin);
    return keypoint;
  }

 private:
  // In the camera's axes. Where the smooth normal of a face that is seen looks away, the face's own.
  Vec3 normal(const Surface& surface, const Hit& hit, const Ray& ray) const {
    const double side = hit.geometric_normal.dot(ray.direction) > 0.0 ? -1.0 : 1.0;
    Vec3 n = side * interpolated(surface.normals, surface, hit).transpose().normalized();
    if (!(n.dot(ray.direction) < 0.0)) n = side * hit.geometric_normal;
    return {n.dot(axes_.right), n.dot(axes_.up), -n.dot(axes_.forward)};
  }

  World world_;
  Camera camera_;
  CameraAxes axes_;
  Lens lens_;
  int width_, height_;
};

void LabelOptions::validate() const {
  const auto require = [](bool ok, const char* name, double value, const char* allowed) {
    if (!ok)
      throw Error(ErrorCode::configuration,
                  fmt::format("labels: {} is {}; allowed: {}", name, value, allowed));
  };
  require(vein_width >= 0.0 && std::isfinite(vein_width), "vein_width", vein_width,
          "0 or more, metres (0: by the leaf's size)");
  require(vein_ratio > 0.0 && vein_ratio <= 1.0, "vein_ratio", vein_ratio, "above 0, up to 1");
}

LeafLabels::LeafLabels(const GlbFile& file, const LabelOptions& options)
    : file_(file),
      metres_(metres_per_unit(file)),
      veins_(file, vein_width(file, options, metres_), options.vein_ratio) {}

LabelMaps LeafLabels::maps(const Scene& scene, const Camera& camera, int width, int height,
                           const Monitor& monitor) const {
  PictureOptions picture;
  picture.width = width, picture.height = height, picture.camera = camera;
  picture.validate();
  validate(scene);
  const auto pixels = std::size_t(width) * std::size_t(height);
  LabelMaps maps;
  maps.width = width, maps.height = height;
  maps.part.assign(pixels, 0), maps.vein.assign(pixels, 0), maps.water.assign(pixels, 0.0F);
  maps.depth.assign(pixels, std::numeric_limits<float>::infinity());
  maps.normals.setZero(Eigen::Index(pixels), 3);
  const Painter painter(scene, camera, width, height);
  for (int top = 0; top < height; top += kRows) {
    monitor.throw_if_cancelled();
    monitor.report("labels", double(top) / height);
    parallel_for(std::min(kRows, height - top), 1, [&](int begin, int end) {
      for (int y = top + begin; y < top + end; ++y)
        for (int x = 0; x < width; ++x) painter.paint(x, y, veins_, metres_, maps);
    });
  }
  monitor.report("labels", 1.0);
  measure(maps);
  add_keypoints(painter, scene, maps);
  for (int order = 1; order <= veins_.highest(); ++order)
    maps.vein_width[order] = veins_.width(order) * metres_;
  maps.camera = camera;
  maps.camera.eye *= metres_;
  return maps;
}

// The blade's vertices come first in its refined surface, so faces of the file find their corners there.
void LeafLabels::add_keypoints(const Painter& painter, const Scene& scene, LabelMaps& maps) const {
  const GlbMesh& blade = file_.meshes.front();
  const auto place = [&](const GlbVein& vein, std::size_t i, const Points3& positions) -> Vec3 {
    Vec3 point = Vec3::Zero();
    for (int c = 0; c < 3; ++c)
      point +=
          vein.barycentric(Eigen::Index(i), c) * positions.row(blade.faces(vein.faces[i], c)).transpose();
    return point;
  };
  const Points3 &rest = blade.frames.front(), &shown = scene.surfaces.front().positions;
  WILT_CHECK(file_.veins.empty() || shown.rows() >= rest.rows(), shown.rows(), rest.rows());
  double farthest = 0.0;
  for (const GlbVein& vein : file_.veins) {
    if (vein.order != 1 || vein.faces.empty()) continue;
    if (maps.base.empty()) maps.base.push_back(painter.keypoint(place(vein, 0, shown)));
    const std::size_t last = vein.faces.size() - 1;
    const double distance = (place(vein, last, rest) - place(vein, 0, rest)).norm();
    if (distance > farthest) farthest = distance, maps.apex = static_cast<int>(maps.tips.size());
    maps.tips.push_back(painter.keypoint(place(vein, last, shown)));
  }
}

Eigen::VectorXd skin_water(const Leaf& leaf, const Eigen::VectorXd& water_fraction) {
  Eigen::VectorXd water(static_cast<Eigen::Index>(leaf.skin.vertex.size()));
  for (std::size_t s = 0; s < leaf.skin.vertex.size(); ++s)
    water[Eigen::Index(s)] = water_fraction[leaf.skin.vertex[s]];
  return water;
}

}  // namespace wilt
