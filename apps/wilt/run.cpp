#include "run.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>

#include "wilt/core/error.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/tube.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/simulation/colour.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

GlbScene glb_scene(const WitheredLeaf& withered) {
  const LeafColours& colours = species(withered.config.species).colours;
  GlbScene scene{withered.leaf, withered.result.frames};
  scene.venation = &withered.venation;
  scene.config = to_json(withered.config);
  for (const Frame& frame : withered.result.frames)
    scene.colours.push_back(leaf_colours(withered.leaf, withered.venation, colours, frame.dryness));
  scene.stalk_colours.push_back(linear_rgb(colours.stalk));
  return scene;
}

// The leaf as it would lie on a table: its mean normal up. How it hangs is for the files to show.
Frame laid_down(const SurfaceMesh& mesh, const Frame& frame) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(area_vector(mesh, frame.positions), Vec3::UnitZ());
  Frame laid = frame;
  laid.positions = frame.positions * turn.toRotationMatrix().transpose();
  if (frame.stalk.rows() > 0) laid.stalk = frame.stalk * turn.toRotationMatrix().transpose();
  return laid;
}

std::vector<VeinLine> vein_lines(const WitheredLeaf& withered, const Frame& frame) {
  const double length = leaf_length(withered.leaf);
  const LeafColours& colours = species(withered.config.species).colours;
  const double dryness = frame.dryness.mean();
  std::vector<VeinLine> lines;
  for (const Vein& vein : withered.venation.veins) {
    VeinLine line;
    line.order = vein.order;
    line.radius = (vein.order == 1 ? 0.0045 : 0.0020) * length;
    line.colour = (1.0 - 0.7 * dryness) * linear_rgb(colours.vein) + 0.7 * dryness * linear_rgb(colours.dry);
    line.positions.resize(static_cast<int>(vein.path.points.size()), 3);
    for (int i = 0; i < line.positions.rows(); ++i)
      line.positions.row(i) = position(withered.leaf.mesh, frame.positions, vein.path.points[i]).transpose();
    if (line.positions.rows() >= 2) lines.push_back(std::move(line));
  }
  return lines;
}

Surface stalk_surface(const Leaf& leaf, const Frame& frame, const Vec3& colour) {
  const Tube shape = tube(frame.stalk, leaf.stalk.radii, 12, tube_reference(leaf.stalk.centreline));
  Surface surface;
  surface.positions = shape.positions;
  surface.normals = shape.normals;
  surface.faces = shape.faces;
  surface.colours = Points3::Ones(shape.positions.rows(), 3) * colour.asDiagonal();
  surface.leaf = false;
  return surface;
}

}  // namespace

WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal) {
  const Monitor monitor = terminal.monitor();
  WitheredLeaf withered;
  withered.config = config;
  Clock::time_point start = Clock::now();
  withered.leaf = load_leaf(request, monitor);
  withered.timings.leaf = seconds_since(start);

  withered.venation =
      find_venation(withered.leaf, species(config.species).secondary, venation_options(config), monitor);
  withered.timings.geodesics = withered.venation.timings.geodesics;
  withered.timings.embedding = withered.venation.timings.embedding;
  withered.timings.venation = withered.venation.timings.venation;
  terminal.say(fmt::format("{}: {} vertices, {:.0f} mm, {} vein tip{}", withered.leaf.name,
                           withered.leaf.mesh.num_vertices(), 1e3 * leaf_length(withered.leaf),
                           withered.venation.tips.size(), withered.venation.tips.size() == 1 ? "" : "s"));

  start = Clock::now();
  withered.result = simulate(withered.leaf, withered.venation, withered.config, monitor);
  withered.timings.simulation = seconds_since(start);
  return withered;
}

void check_result_path(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".glb" && extension != ".obj" && extension != ".png")
    throw Error(ErrorCode::configuration,
                fmt::format("cannot write '{}': results are .glb (all frames), .obj (the last frame) or .png "
                            "(a picture of it)",
                            path));
  check_writable(path);
}

void check_writable(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(ErrorCode::output, fmt::format("cannot write '{}': there is no folder '{}'; create it first",
                                               path, folder.string()));
}

void write_result(const std::string& path, const WitheredLeaf& withered, Terminal& terminal) {
  const std::string extension = lower_extension(path);
  if (extension == ".glb") {
    GlbOptions options;
    options.seconds = withered.config.clip.seconds;
    write_glb(path, glb_scene(withered), options);
  } else if (extension == ".obj") {
    write_obj(path, withered.leaf, withered.result.frames.back());
  } else {
    write_png(path,
              picture_of(withered, withered.result.frames.back(), kPictureWidth, kPictureHeight, terminal));
  }
}

std::string report_of(const WitheredLeaf& withered) {
  return report_json(withered.leaf, withered.venation, withered.result, to_json(withered.config),
                     withered.timings);
}

Image picture_of(const WitheredLeaf& withered, const Frame& hanging, int width, int height,
                 Terminal& terminal) {
  const Leaf& leaf = withered.leaf;
  const Frame frame = laid_down(leaf.mesh, hanging);
  const LeafColours& colours = species(withered.config.species).colours;
  Surface blade;
  blade.positions = frame.positions;
  blade.faces = leaf.mesh.face_matrix();
  blade.colours = leaf_colours(leaf, withered.venation, colours, frame.dryness);
  const double length = leaf_length(leaf);
  blade.uv = leaf.positions.leftCols<2>() / length;
  Scene scene;
  scene.surfaces.push_back(std::move(blade));
  if (frame.stalk.rows() >= 2)
    scene.surfaces.push_back(stalk_surface(leaf, frame, linear_rgb(colours.stalk)));
  scene.veins = vein_lines(withered, frame);
  PictureOptions options;
  options.width = width;
  options.height = height;
  return render(scene, options, terminal.monitor());
}

}  // namespace wilt::cli
