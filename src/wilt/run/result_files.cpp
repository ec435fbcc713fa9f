#include "wilt/run/result_files.hpp"

#include <fmt/format.h>

#include "wilt/output/glb_scene.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/render/picture.hpp"
#include "wilt/run/result_formats.hpp"

namespace wilt {

void ResultFiles::write(const std::string& path) {
  result_format(path).write(*this, path);
}

Image ResultFiles::picture(int frame, int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  return render(scene().at(frame), options, monitor_);
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
    monitor_.say(
        fmt::format("the .glb has {} of {} frames; between them it is off by {:.2g} mm (root mean square), "
                    "{:.2g} mm at most",
                    choice.kept.size(), clip().frames.size(), 1e3 * choice.rms, 1e3 * choice.largest));
  return glb_bytes(scene);
}

const GlbFile& ResultFiles::glb_file() {
  if (!file_) file_ = parse_glb(files_.max_morphs == 0 ? glb() : make_glb(0), withered_.leaf.name);
  return *file_;
}

const LeafScene& ResultFiles::scene() {
  if (!scene_) scene_.emplace(glb_file());
  return *scene_;
}

}  // namespace wilt
