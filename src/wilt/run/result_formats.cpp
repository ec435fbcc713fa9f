#include "wilt/run/result_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/game/animation_texture.hpp"
#include "wilt/game/texel_layout.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/output/ply.hpp"
#include "wilt/output/point_cache.hpp"
#include "wilt/output/usd.hpp"
#include "wilt/output/vtk.hpp"
#include "wilt/run/result_files.hpp"

namespace wilt {
namespace {

using Files = std::vector<ResultFile>;

constexpr int kPictureWidth = 960, kPictureHeight = 720;

Files itself(const std::string& path, int) {
  return {{path}};
}

void add_maps(Files& files, const std::string& texture_of, const std::string& normal_map_of) {
  files.push_back({beside(texture_of, ".texture.jpg"), true});
  files.push_back({beside(normal_map_of, ".normal.jpg"), true});
}

Files usd_files(const std::string& path, int) {
  Files files{{path}};
  add_maps(files, path, path);
  return files;
}

// The files of a path in whose name a row of hashes may stand for the frame's number.
Files numbered(const std::string& path, int frames) {
  if (!is_sequence(path)) return {{path}};
  check_sequence(path);
  Files files;
  for (int k = 0; k < frames; ++k) files.push_back({sequence_path(path, k)});
  return files;
}

Files obj_files(const std::string& path, int frames) {
  const std::string stem = is_sequence(path) ? sequence_stem(path) : path;
  Files files{{beside(stem, ".mtl")}};
  for (const ResultFile& file : numbered(path, frames)) {
    files.push_back(file);
    add_maps(files, file.path, stem);
  }
  return files;
}

Files pvd_files(const std::string& path, int frames) {
  Files files{{path}};
  for (int k = 0; k < frames; ++k) {
    files.push_back({pvd_blade_path(path, k)});
    files.push_back({pvd_stalk_path(path, k)});
  }
  return files;
}

Files cache_files(const std::string& path, int) {
  return {{path}, {beside(path, ".stalk" + extension_of(path))}};
}

void write_obj_files(ResultFiles& result, const std::string& path) {
  if (is_sequence(path)) return write_obj_sequence(path, result.shown(), result.options());
  write_obj(path, result.shown(), result.last_frame(), result.options());
}

/// The last frame, or every frame by its number.
template <void (*write)(const std::string&, const ShownColours&, int, const ClipOptions&)>
void write_frames(ResultFiles& result, const std::string& path) {
  if (!is_sequence(path)) return write(path, result.shown(), result.last_frame(), result.options());
  for (int k = 0; k <= result.last_frame(); ++k)
    write(sequence_path(path, k), result.shown(), k, result.options());
}

Files vat_files(const std::string& path, int frames) {
  TexelLayout::make(1, frames);  // refuses what no leaf could fit
  Files files;
  for (const std::string& file : animation_texture_files(path)) files.push_back({file});
  return files;
}

void write_vat(ResultFiles& result, const std::string& path) {
  const AnimationTextureOptions options{result.options(), result.files().vat_png, result.files().lods};
  const std::vector<WrittenLevel> levels = write_animation_texture(path, result.clip(), options);
  for (std::size_t level = 1; level < levels.size(); ++level)
    result.monitor().say(fmt::format("level {}: {} of {} triangles, off by {:.2g} mm at most", level,
                                     levels[level].triangles, levels.front().triangles,
                                     1e3 * levels[level].deviation));
}

void write_picture(ResultFiles& result, const std::string& path) {
  write_image(path, result.picture(result.last_frame(), kPictureWidth, kPictureHeight));
}

std::string extensions_of(const ResultFormat& format) {
  return fmt::format("{}", fmt::join(format.extensions, " "));
}

bool ends_in(const std::string& path, const std::string& extension) {
  std::string end = path.substr(path.size() - std::min(path.size(), extension.size()));
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end == extension;
}

}  // namespace

const std::vector<ResultFormat>& result_formats() {
  static const std::vector<ResultFormat> kFormats = {
      {{".glb"},
       "all frames, with colours and texture",
       itself,
       [](ResultFiles& result, const std::string& path) { write_file(path, result.glb()); }},
      {{".usda"},
       "all frames as time samples; its maps beside it",
       usd_files,
       [](ResultFiles& result, const std::string& path) {
         write_usd(path, result.shown(), result.options());
       }},
      {{".vat.json"},
       "all frames as textures of positions, normals and colours, for game engines",
       vat_files,
       write_vat},
      {{".pc2", ".mdd"},
       "positions of all frames, for the .obj's mesh",
       cache_files,
       [](ResultFiles& result, const std::string& path) {
         write_point_caches(path, result.clip(), result.options());
       }},
      {{".pvd"},
       "all frames with their figures as .vtu beside it, for ParaView",
       pvd_files,
       [](ResultFiles& result, const std::string& path) {
         write_pvd(path, result.shown(), result.options());
       }},
      {{".obj"},
       "the last frame, with material and maps; leaf.####.obj: every frame",
       obj_files,
       write_obj_files},
      {{".ply"},
       "the last frame, with colours; leaf.####.ply: every frame",
       numbered,
       write_frames<write_ply>},
      {{".vtu"},
       "the last frame with its figures; leaf.####.vtu: every frame",
       numbered,
       write_frames<write_vtu>},
      {{".png", ".jpg", ".jpeg"}, "a picture of the last frame", itself, write_picture},
  };
  return kFormats;
}

const ResultFormat& result_format(const std::string& path) {
  const ResultFormat* found = nullptr;
  std::size_t longest = 0;
  std::vector<std::string> all;
  for (const ResultFormat& format : result_formats()) {
    all.push_back(fmt::format("{} ({})", extensions_of(format), format.content));
    for (const std::string& extension : format.extensions) {
      if (extension.size() <= longest || !ends_in(path, extension)) continue;
      longest = extension.size();
      found = &format;
    }
  }
  if (found != nullptr) return *found;
  throw Error(ErrorCode::configuration,
              fmt::format("cannot write '{}': results are {}", path, fmt::join(all, ", ")));
}

std::string result_formats_help() {
  std::string text;
  for (const ResultFormat& format : result_formats())
    text += fmt::format("\n  {:<16} {}", extensions_of(format), format.content);
  return text;
}

std::vector<std::string> result_files(const std::vector<std::string>& paths, int frames) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    for (const ResultFile& file : result_format(path).files(path, frames)) {
      if (std::find(files.begin(), files.end(), file.path) == files.end()) files.push_back(file.path);
    }
  }
  return files;
}

void check_results(const std::vector<std::string>& paths, const std::vector<std::string>& others,
                   int frames) {
  struct Writer {
    std::string path;
    bool common;
  };
  std::map<std::string, Writer> writers;
  const auto claim = [&writers](const ResultFile& file, const std::string& path) {
    const std::string key = std::filesystem::absolute(file.path).lexically_normal().string();
    const auto [place, is_new] = writers.try_emplace(key, Writer{path, file.common});
    const Writer& before = place->second;
    if (is_new || before.path == path || (before.common && file.common)) return;
    throw Error(ErrorCode::configuration,
                fmt::format("'{}' and '{}' would both write '{}'; give one another name", before.path, path,
                            file.path));
  };
  for (const std::string& path : paths) {
    const ResultFormat& format = result_format(path);
    for (const ResultFile& file : format.files(path, frames)) {
      check_writable(file.path);
      claim(file, path);
    }
  }
  for (const std::string& path : others) {
    check_writable(path);
    claim({path}, path);
  }
}

}  // namespace wilt
