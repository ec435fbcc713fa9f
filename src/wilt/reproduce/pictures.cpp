#include "wilt/reproduce/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "wilt/mesh/geometry.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/tube.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/render/tone.hpp"
#include "wilt/simulation/colour.hpp"

namespace wilt {
namespace {

constexpr Finish kMatt{0.0, 0.0, 0.5, 0.0};
constexpr double kDrawnVein = 0.007;  // radius of a vein that is drawn over the leaf, in lengths
constexpr double kFromAbove = std::numbers::pi / 2.0;

GlbFile glb_of(const Experiment& experiment) {
  const Subject& subject = experiment.subject;
  return parse_glb(
      glb_bytes(glb_scene(subject.leaf, subject.venation, experiment.config, experiment.result.frames)),
      "the leaf");
}

std::vector<Scene> scenes_of(const std::vector<Shot>& shots) {
  std::map<const Experiment*, GlbFile> files;
  std::vector<Scene> scenes;
  for (const Shot& shot : shots) {
    const auto [file, is_new] = files.try_emplace(shot.experiment);
    if (is_new) file->second = glb_of(*shot.experiment);
    const int last = static_cast<int>(file->second.times.size()) - 1;
    scenes.push_back(leaf_scene(file->second, std::min(shot.frame, last)));
  }
  return scenes;
}

Points3 stacked(const std::vector<Points3>& parts) {
  Eigen::Index rows = 0;
  for (const Points3& part : parts) rows += part.rows();
  Points3 all(rows, 3);
  Eigen::Index row = 0;
  for (const Points3& part : parts) {
    all.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return all;
}

// The blade alone, upright in a picture taken from above.
Surface bare_blade(const Subject& subject) {
  Surface blade;
  blade.positions = subject.leaf.positions;
  blade.faces = subject.leaf.mesh.face_matrix();
  blade.leaf = false;
  blade.finish = kMatt;
  return blade;
}

// A vein as a matt vermilion tube.
Surface drawn_vein(const Points3& line, double radius) {
  const std::vector<double> radii(static_cast<std::size_t>(line.rows()), radius);
  const Tube shape = tube(line, radii, 12, tube_reference(line));
  Surface surface;
  surface.positions = shape.positions;
  surface.normals = shape.normals;
  surface.faces = shape.faces;
  surface.colours = Points3::Ones(shape.positions.rows(), 3) * linear_rgb({213, 94, 0}).asDiagonal();
  surface.leaf = false;
  surface.finish = kMatt;
  return surface;
}

// A flat drawing in colours as they are given: an even sky, no sun, no ground.
PictureOptions drawing_options(const PictureSettings& settings, const Points3& points) {
  PictureOptions options;
  options.width = settings.width;
  options.height = settings.height;
  options.samples = settings.samples;
  options.seed = settings.seed;
  options.ground = false;
  options.bounces = 1;
  options.lighting.sun.irradiance.setZero();
  options.lighting.sky = {Vec3::Constant(kToneWhite), Vec3::Constant(kToneWhite), Vec3::Constant(kToneWhite)};
  options.view.azimuth = -kFromAbove;
  options.view.elevation = kFromAbove;
  const double aspect = static_cast<double>(settings.width) / settings.height;
  options.camera = frame_camera(points, aspect, options.view);
  return options;
}

// The reflectance that a drawing shows as the sRGB colour.
Vec3 drawn(const Vec3& srgb) {
  return radiance_of(srgb) / kToneWhite;
}

}  // namespace

Vec3 viridis(double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (kViridis.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(x), kViridis.size() - 2);
  Vec3 colour;
  for (int c = 0; c < 3; ++c)
    colour[c] =
        (kViridis[k][c] + (x - static_cast<double>(k)) * (kViridis[k + 1][c] - kViridis[k][c])) / 255.0;
  return colour;
}

std::vector<Image> Pictures::render_all(const std::vector<Scene>& scenes, const Points3& seen,
                                        double scale) const {
  PictureOptions options;
  options.width = std::max(16, static_cast<int>(scale * settings_.width));
  options.height = std::max(12, static_cast<int>(scale * settings_.height));
  options.samples = settings_.samples;
  options.seed = settings_.seed;
  options.camera = frame_camera(seen, static_cast<double>(options.width) / options.height, options.view);
  std::vector<Image> images;
  for (const Scene& scene : scenes) images.push_back(render(scene, options, cancel_));
  return images;
}

std::vector<Image> Pictures::row(const std::vector<Shot>& shots, double scale) const {
  const std::vector<Scene> scenes = scenes_of(shots);
  std::vector<Points3> seen;
  for (const Scene& scene : scenes) seen.push_back(scene.surfaces.front().positions);
  return render_all(scenes, stacked(seen), scale);
}

std::vector<Image> Pictures::close_ups(const std::vector<Shot>& shots,
                                       const std::vector<VertexId>& focus) const {
  const std::vector<Scene> scenes = scenes_of(shots);
  std::vector<Points3> seen;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& skin = shots[i].experiment->subject.leaf.skin.vertex;
    const Points3& blade = scenes[i].surfaces.front().positions;
    for (std::size_t s = 0; s < skin.size(); ++s) {
      if (std::find(focus.begin(), focus.end(), skin[s]) != focus.end())
        seen.push_back(blade.row(static_cast<Eigen::Index>(s)));
    }
  }
  return render_all(scenes, stacked(seen), 1.0);
}

Image Pictures::veins(const Experiment& experiment) const {
  Scene scene = scenes_of({{&experiment, 0}}).front();
  PictureOptions options;
  options.width = settings_.width;
  options.height = settings_.height;
  options.samples = settings_.samples;
  options.seed = settings_.seed;
  options.view.azimuth = -kFromAbove;
  options.view.elevation = kFromAbove;
  const Points3 blade = scene.surfaces.front().positions;
  options.camera = frame_camera(blade, static_cast<double>(options.width) / options.height, options.view);
  const double radius = kDrawnVein * leaf_length(experiment.subject.leaf);
  std::vector<Surface> tubes;
  for (const VeinLine& vein : scene.veins) {
    if (vein.order == 1) tubes.push_back(drawn_vein(vein.positions, radius));
  }
  for (Surface& tube : tubes) scene.surfaces.push_back(std::move(tube));
  return render(scene, options, cancel_);
}

Image Pictures::colour_map(const Subject& subject, const Eigen::VectorXd& values, double least,
                           double most) const {
  Surface blade = bare_blade(subject);
  blade.colours.resize(values.size(), 3);
  for (Eigen::Index v = 0; v < values.size(); ++v)
    blade.colours.row(v) = drawn(viridis((values[v] - least) / (most - least))).transpose();
  Scene scene;
  scene.surfaces.push_back(std::move(blade));
  return render(scene, drawing_options(settings_, subject.leaf.positions), cancel_);
}

}  // namespace wilt
