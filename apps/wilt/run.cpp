#include "run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>

#include "interrupts.hpp"
#include "result_formats.hpp"
#include "wilt/core/error.hpp"
#include "wilt/output/glb_scene.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal,
                    const CheckpointOptions& checkpoint) {
  end_on_interrupt();  // nothing is worth keeping before the first frame
  Checkpoints checkpoints(checkpoint, terminal);
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
  Simulation simulation(withered.leaf, withered.venation, withered.config);
  checkpoints.resume(simulation);
  ask_on_interrupt();
  withered.result =
      simulate(std::move(simulation), monitor, [&](const Simulation& now) { checkpoints.save(now); });
  withered.timings.simulation = seconds_since(start);
  return withered;
}

void check_writable(const std::string& path) {
  const auto refuse = [&path](const std::string& reason) {
    throw Error(ErrorCode::output, fmt::format("cannot write '{}': {}; choose another path", path, reason));
  };
  if (std::filesystem::is_directory(path)) refuse("it is a folder, not the name of a file in one");
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? "." : parent;
  if (!std::filesystem::is_directory(folder))
    refuse(fmt::format("there is no folder '{0}'; make it (mkdir -p '{0}')", folder));
  const bool is_new = !std::filesystem::exists(path);
  if (::access(is_new ? folder.c_str() : path.c_str(), is_new ? W_OK | X_OK : W_OK) != 0)
    refuse(fmt::format("{}; allow writing there (chmod u+w)", std::strerror(errno)));
}

void ResultFiles::write(const std::string& path) {
  result_format(path).write(*this, path);
}

Image ResultFiles::picture(int frame, int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  return render(scene().at(frame), options, terminal_.monitor());
}

const Clip& ResultFiles::clip() {
  if (!clip_)
    clip_.emplace(make_clip(withered_.leaf, withered_.venation, withered_.config, withered_.result.frames));
  return *clip_;
}

const ShownColours& ResultFiles::shown() {
  if (!shown_) shown_.emplace(clip());
  return *shown_;
}

ClipOptions ResultFiles::options() const {
  ClipOptions options;
  options.seconds = withered_.config.clip.seconds;
  options.hours_per_iteration = withered_.config.clip.hours / 100.0;
  return options;
}

const std::string& ResultFiles::glb() {
  if (glb_.empty()) glb_ = make_glb(files_.max_morphs);
  return glb_;
}

std::string ResultFiles::make_glb(int max_morphs) {
  GlbOptions options;
  options.seconds = withered_.config.clip.seconds;
  options.max_morphs = max_morphs;
  const GlbScene scene = glb_scene(clip(), options);
  const FrameChoice& choice = scene.frames;
  if (choice.kept.size() < clip().frames.size())
    terminal_.say(
        fmt::format("the .glb has {} of {} frames; between them it is off by {:.2g} mm (root mean square), "
                    "{:.2g} mm at most",
                    choice.kept.size(), clip().frames.size(), 1e3 * choice.rms, 1e3 * choice.largest));
  return glb_bytes(scene);
}

const LeafScene& ResultFiles::scene() {
  if (!scene_) {  // pictures show any frame
    file_ = parse_glb(files_.max_morphs == 0 ? glb() : make_glb(0), withered_.leaf.name);
    scene_.emplace(file_);
  }
  return *scene_;
}

std::string report_of(const WitheredLeaf& withered) {
  return report_json(withered.leaf, withered.venation, withered.result, to_json(withered.config),
                     withered.timings);
}

}  // namespace wilt::cli
