// What a run leaves behind, for Python.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "objects.hpp"
#include "wilt/core/image.hpp"

namespace wilt::python {

/// How `save` writes files.
struct SaveOptions {
  int max_morphs = 0;       ///< frames in a .glb, 2 or more: those whose playback misses the least; 0: all
  int lods = 0;             ///< coarser meshes beside a .vat.json, 0 to 8
  std::string vat = "exr";  ///< textures of a .vat.json: "exr" (half floats) or "png" (16 bits)
};

/// Writes the result, as `wilt simulate -o` does: the format is that of the end of a name (docs/formats.md).
/// Each file is whole or not there. Raises ValueError for a name of no format, OSError for what cannot be
/// written; what can be known of both is said before the work.
void save(const ResultObject& result, const std::vector<std::filesystem::path>& paths,
          const SaveOptions& options);

/// A rendered picture of a frame, the leaf lying on a table: height x width x 3 bytes, sRGB. frame: -1 is the
/// last.
Image picture(const ResultObject& result, int frame, int width, int height);

}  // namespace wilt::python
