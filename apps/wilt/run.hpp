// A whole run: leaf, veins, simulation, files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "checkpoints.hpp"
#include "load_leaf.hpp"
#include "terminal.hpp"
#include "wilt/core/image.hpp"
#include "wilt/output/clip_options.hpp"
#include "wilt/output/report.hpp"
#include "wilt/output/shown_colours.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/result.hpp"

namespace wilt::cli {

/// What a run has computed, with the time each stage took.
struct WitheredLeaf {
  Leaf leaf;
  Venation venation;
  Config config;
  SimulationResult result;
  Timings timings;
};

/// Loads the leaf, finds its veins and withers it. The leaf's notes go to the terminal. Throws before any
/// work where the checkpoint's options are wrong (checkpoints.hpp).
WitheredLeaf wither(const LeafRequest& request, const Config& config, Terminal& terminal,
                    const CheckpointOptions& checkpoint = {});

/// What the command line says about the files of a result.
struct FileOptions {
  int max_morphs = 0;    ///< of a GLB, 2 or more; 0: all frames
  int lods = 0;          ///< coarser meshes beside vertex-animation textures, 0 to 8
  bool vat_png = false;  ///< those as 16-bit PNG rather than EXR
};

/// A withered leaf as files and pictures; what they share is made once, when the first needs it.
class ResultFiles {
 public:
  /// Refers to the leaf and the terminal, which must outlive it.
  ResultFiles(const WitheredLeaf& withered, Terminal& terminal, const FileOptions& files = {})
      : withered_(withered), terminal_(terminal), files_(files) {}

  /// By extension, result_formats.hpp.
  void write(const std::string& path);

  /// A picture of a frame (0 to last_frame()), lying on a table.
  Image picture(int frame, int width, int height);
  int last_frame() const { return static_cast<int>(withered_.result.frames.size()) - 1; }

  const Clip& clip();
  const ShownColours& shown();
  const std::string& glb();
  ClipOptions options() const;
  const FileOptions& files() const { return files_; }
  Terminal& terminal() { return terminal_; }

 private:
  std::string make_glb(int max_morphs);
  const LeafScene& scene();

  const WitheredLeaf& withered_;
  Terminal& terminal_;
  FileOptions files_;
  std::optional<Clip> clip_;
  std::optional<ShownColours> shown_;  // refers to clip_
  std::string glb_;
  GlbFile file_;
  std::optional<LeafScene> scene_;  // refers to file_
};

/// Throws Error{output} unless `path` can become a file: its folder exists and may be written to.
void check_writable(const std::string& path);

/// The text of report.json.
std::string report_of(const WitheredLeaf& withered);

}  // namespace wilt::cli
