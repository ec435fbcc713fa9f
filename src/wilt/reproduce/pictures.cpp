#include "wilt/reproduce/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "wilt/core/srgb.hpp"
#include "wilt/core/stack_rows.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/tube.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/render/tone.hpp"

namespace wilt {
namespace {

constexpr Finish kMatt{0.0, 0.0, 0.5, 0.0};  // no translucency, no gloss, no relief
constexpr int kTexels = 512;                 // enough for pictures of this size
constexpr double kDrawnVein = 0.007;         // radius of a vein that is drawn over the leaf, in lengths
constexpr double kFromAbove = std::numbers::pi / 2.0;

GlbFile glb_of(const Experiment& experiment) {
  const Subject& subject = experiment.subject;
  Config config = experiment.config;
  config.texture.size = kTexels;
  return parse_glb(glb_bytes(make_clip(subject.leaf, subject.venation, config, experiment.result.frames)),
                   "the leaf");
}

std::vector<Scene> scenes_of(const std::vector<Shot>& shots) {
  struct Table {
    GlbFile file;
    LeafScene scene;
    explicit Table(const Experiment& experiment) : file(glb_of(experiment)), scene(file) {}
  };
  std::map<const Experiment*, std::unique_ptr<Table>> tables;
  std::vector<Scene> scenes;
  for (const Shot& shot : shots) {
    auto& table = tables[shot.experiment];
    if (!table) table = std::make_unique<Table>(*shot.experiment);
    scenes.push_back(table->scene.at(std::min(shot.frame, table->scene.frames() - 1)));
  }
  return scenes;
}

// The points of a vein on the blade of a scene, whose first vertices are the file's.
Points3 on_blade(const GlbFile& file, const GlbVein& vein, const Surface& blade) {
  Points3 line = Points3::Zero(static_cast<int>(vein.faces.size()), 3);
  for (int i = 0; i < line.rows(); ++i) {
    const auto corners = file.meshes.front().faces.row(vein.faces[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 3; ++k) line.row(i) += vein.barycentric(i, k) * blade.positions.row(corners[k]);
  }
  return line;
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

double aspect_of(const PictureOptions& options) {
  return static_cast<double>(options.width) / options.height;
}

PictureOptions options_of(const PictureSettings& settings, double scale) {
  PictureOptions options;
  options.width = std::max(16, static_cast<int>(scale * settings.width));
  options.height = std::max(12, static_cast<int>(scale * settings.height));
  options.samples = settings.samples;
  options.seed = settings.seed;
  return options;
}

// A flat drawing in colours as they are given: an even sky, no sun, no ground.
PictureOptions drawing_options(const PictureSettings& settings, const Points3& points) {
  PictureOptions options = options_of(settings, 1.0);
  options.ground = false;
  options.bounces = 1;
  options.lighting.sun.irradiance.setZero();
  options.lighting.sky = {Vec3::Constant(kToneWhite), Vec3::Constant(kToneWhite), Vec3::Constant(kToneWhite)};
  options.view.azimuth = -kFromAbove;
  options.view.elevation = kFromAbove;
  options.camera = frame_camera(points, aspect_of(options), options.view);
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
  PictureOptions options = options_of(settings_, scale);
  options.camera = frame_camera(seen, aspect_of(options), options.view);
  std::vector<Image> images;
  for (const Scene& scene : scenes) images.push_back(render(scene, options, cancel_));
  return images;
}

std::vector<Image> Pictures::row(const std::vector<Shot>& shots, double scale) const {
  const std::vector<Scene> scenes = scenes_of(shots);
  std::vector<Points3> seen;
  for (const Scene& scene : scenes) seen.push_back(scene.surfaces.front().positions);
  return render_all(scenes, stack_rows(seen), scale);
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
  return render_all(scenes, stack_rows(seen), 1.0);
}

Image Pictures::veins(const Experiment& experiment) const {
  const GlbFile file = glb_of(experiment);
  Scene scene = leaf_scene(file, 0);
  PictureOptions options = options_of(settings_, 1.0);
  options.view.azimuth = -kFromAbove;
  options.view.elevation = kFromAbove;
  const Surface blade = scene.surfaces.front();
  options.camera = frame_camera(blade.positions, aspect_of(options), options.view);
  const double radius = kDrawnVein * leaf_length(experiment.subject.leaf);
  for (const GlbVein& vein : file.veins) {
    if (vein.order == 1) scene.surfaces.push_back(drawn_vein(on_blade(file, vein, blade), radius));
  }
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
