#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/clip_options.hpp"
#include "wilt/output/frame_choice.hpp"
#include "wilt/output/glb_extras.hpp"
#include "wilt/output/glb_scene.hpp"
#include "wilt/output/gltf.hpp"

namespace wilt {
namespace {

void check_clip(const Clip& clip) {
  const std::size_t frames = clip.frames.size();
  WILT_CHECK(frames >= 1, frames);
  WILT_CHECK(clip.colours.size() <= 1 || clip.colours.size() == frames, clip.colours.size(), frames);
  WILT_CHECK(clip.stalk_colours.size() <= 1 || clip.stalk_colours.size() == frames, clip.stalk_colours.size(),
             frames);
  const int vertices = clip.leaf.mesh.num_vertices();
  WILT_CHECK(nlohmann::json::accept(clip.config), clip.config);
  for (const Points3& colours : clip.colours)
    WILT_CHECK(colours.rows() == vertices, colours.rows(), vertices);
  for (std::size_t k = 0; k < frames; ++k) {
    const Frame& frame = clip.frames[k];
    WILT_CHECK(frame.positions.rows() == vertices, k, frame.positions.rows(), vertices);
    WILT_CHECK(frame.positions.allFinite() && frame.stalk.allFinite(), k, frame.iteration);
    WILT_CHECK(frame.stalk.rows() == clip.frames[0].stalk.rows(), k, frame.stalk.rows());
    WILT_CHECK(k == 0 || frame.iteration > clip.frames[k - 1].iteration, k, frame.iteration);
  }
}

}  // namespace

void GlbOptions::validate() const {
  if (!(seconds > 0.0 && std::isfinite(seconds))) {
    throw Error(ErrorCode::configuration,
                fmt::format("seconds is {}: the length of the clip must be above 0", seconds));
  }
  if (stalk_sides < 3 || stalk_sides > 64) {
    throw Error(ErrorCode::configuration,
                fmt::format("stalk_sides is {}: a stalk has 3 to 64 sides", stalk_sides));
  }
  if (max_morphs == 1 || max_morphs < 0) {
    throw Error(ErrorCode::configuration,
                fmt::format("max_morphs is {}: 2 or more, or 0 for all frames", max_morphs));
  }
}

std::vector<Frame> rest_frames(const Leaf& leaf) {
  Frame frame;
  frame.positions = leaf.positions;
  frame.stalk = leaf.stalk.centreline;
  frame.dryness = Eigen::VectorXd::Zero(leaf.positions.rows());
  return {frame};
}

GlbScene glb_scene(const Clip& clip, const GlbOptions& options) {
  options.validate();
  check_clip(clip);
  GlbScene scene;
  scene.meshes.push_back(moving_blade(clip));
  if (clip.frames.front().stalk.rows() >= 2) scene.meshes.push_back(moving_stalk(clip, options.stalk_sides));
  const int all = std::max(2, static_cast<int>(clip.frames.size()));
  scene.frames = choose_frames(clip.frames, options.max_morphs > 0 ? options.max_morphs : all);
  const std::vector<double> times = key_times(clip.frames, options.seconds);
  for (const int k : scene.frames.kept) {
    scene.iterations.push_back(clip.frames[static_cast<std::size_t>(k)].iteration);
    scene.times.push_back(times[static_cast<std::size_t>(k)]);
  }
  scene.texture = clip.texture;
  scene.normal_texture = clip.normal_texture;
  scene.extras = glb_extras(clip, scene.frames);
  return scene;
}

std::string glb_bytes(const Clip& clip, const GlbOptions& options) {
  return glb_bytes(glb_scene(clip, options));
}

void write_glb(const std::string& path, const Clip& clip, const GlbOptions& options) {
  write_file(path, glb_bytes(clip, options));
}

}  // namespace wilt
