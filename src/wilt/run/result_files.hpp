// A withered leaf as files and pictures.
#pragma once

#include <optional>
#include <string>

#include "wilt/core/image.hpp"
#include "wilt/core/monitor.hpp"
#include "wilt/output/clip_options.hpp"
#include "wilt/output/shown_colours.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/run/withered_leaf.hpp"

namespace wilt {

/// How files are written, beyond their names.
struct FileOptions {
  int max_morphs = 0;    ///< of a GLB, 2 or more; 0: all frames
  int lods = 0;          ///< coarser meshes beside vertex-animation textures, 0 to 8
  bool vat_png = false;  ///< those as 16-bit PNG rather than EXR
};

/// The files and pictures of a withered leaf; what they share is made once, when the first needs it.
class ResultFiles {
 public:
  /// Refers to the leaf, which must outlive it. The monitor hears of what was left out of a file.
  explicit ResultFiles(const WitheredLeaf& withered, Monitor monitor = {}, const FileOptions& files = {})
      : withered_(withered), monitor_(std::move(monitor)), files_(files) {}

  /// By extension, result_formats.hpp. Throws Error{configuration} for one of no format, Error{output}.
  void write(const std::string& path);

  /// A picture of a frame (0 to last_frame()), lying on a table.
  Image picture(int frame, int width, int height);
  int last_frame() const { return static_cast<int>(withered_.result.frames.size()) - 1; }

  const Clip& clip();
  const ShownColours& shown();
  const std::string& glb();   ///< the bytes
  const GlbFile& glb_file();  ///< with every frame, as it is read back
  const LeafScene& scene();   ///< of all frames
  ClipOptions options() const;
  const FileOptions& files() const { return files_; }
  const Monitor& monitor() const { return monitor_; }

 private:
  std::string make_glb(int max_morphs);

  const WitheredLeaf& withered_;
  Monitor monitor_;
  FileOptions files_;
  std::optional<Clip> clip_;
  std::optional<ShownColours> shown_;  // refers to clip_
  std::string glb_;
  std::optional<GlbFile> file_;
  std::optional<LeafScene> scene_;  // refers to file_
};

}  // namespace wilt
