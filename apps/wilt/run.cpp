#include "run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "wilt/core/error.hpp"
#include "wilt/output/file.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPictureWidth = 960, kPictureHeight = 720;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal) {
  const Monitor monitor = terminal.monitor();
  WitheredLeaf withered;
  withered.config = config;
  Clock::time_point start = Clock::now();
  withered.leaf = load_leaf(request, monitor);
  withered.timings.leaf = seconds_since(start);

  withered.venation = load_veins(request, withered.leaf, species(config.species).secondary,
                                 venation_options(config), monitor);
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
  const std::string extension = extension_of(path);
  if (extension != ".glb" && extension != ".obj" && !is_picture_path(path))
    throw Error(
        ErrorCode::configuration,
        fmt::format("cannot write '{}': results are .glb (all frames), .obj (the last frame) or .png, "
                    ".jpg (a picture of it)",
                    path));
  check_writable(path);
}

void check_writable(const std::string& path) {
  const auto refuse = [&path](const std::string& reason) {
    throw Error(ErrorCode::output, fmt::format("cannot write '{}': {}", path, reason));
  };
  if (std::filesystem::is_directory(path)) refuse("it is a folder; name a file in it");
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    refuse(fmt::format("there is no folder '{}'; create it first", folder));
  if (!std::filesystem::exists(path) && ::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
    refuse("you may not write into its folder");
}

void ResultFiles::write(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") {
    write_obj(path, withered_.leaf, withered_.result.frames.back());
  } else if (extension == ".glb") {
    write_file(path, glb());
  } else {
    write_image(path, picture(last_frame(), kPictureWidth, kPictureHeight));
  }
}

Image ResultFiles::picture(int frame, int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  return render(scene().at(frame), options, terminal_.monitor());
}

const std::string& ResultFiles::glb() {
  if (glb_.empty()) {
    GlbOptions options;
    options.seconds = withered_.config.clip.seconds;
    glb_ = glb_bytes(make_clip(withered_.leaf, withered_.venation, withered_.config, withered_.result.frames),
                     options);
  }
  return glb_;
}

const LeafScene& ResultFiles::scene() {
  if (!scene_) {
    file_ = parse_glb(glb(), withered_.leaf.name);
    scene_.emplace(file_);
  }
  return *scene_;
}

std::string report_of(const WitheredLeaf& withered) {
  return report_json(withered.leaf, withered.venation, withered.result, to_json(withered.config),
                     withered.timings);
}

}  // namespace wilt::cli
