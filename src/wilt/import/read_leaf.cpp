#include "wilt/import/read_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/mesh_leaf.hpp"
#include "wilt/import/photo_leaf.hpp"
#include "wilt/import/scan_leaf.hpp"
#include "wilt/import/scan_points.hpp"

namespace wilt {
namespace {

bool one_of(const std::string& extension, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), extension) != list.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

bool is_photo(const std::string& extension) {
  return one_of(extension, {".jpg", ".jpeg", ".png"});
}

bool is_points_file(const std::string& extension) {
  return one_of(extension, {".xyz", ".txt", ".csv"});
}

void require_positive(const char* option, const std::optional<double>& value, double most) {
  if (value && !(*value > 0.0 && *value <= most))
    throw Error(ErrorCode::configuration,
                fmt::format("{} {} must be above 0, at most {:g}", option, *value, most));
}

void validate(const ReadOptions& options, const std::string& extension) {
  const bool drawing = extension == ".svg", outline = drawing || extension == ".json";
  const bool photo = is_photo(extension);
  const bool scan = options.scan || is_points_file(extension) || extension == ".ply";
  if (options.vertices && (*options.vertices < 200 || *options.vertices > 1'000'000))
    throw Error(ErrorCode::configuration,
                fmt::format("--vertices {} must be from 200 to 1000000", *options.vertices));
  if (options.petiole && !options.petiole->allFinite())
    throw Error(ErrorCode::configuration, "--petiole must be two finite numbers X,Y");
  if (options.nth < 1)
    throw Error(ErrorCode::configuration, fmt::format("--leaf {} must be 1 or more", options.nth));
  if (options.nth > 1 && !drawing && !photo && !scan)
    throw Error(
        ErrorCode::configuration,
        fmt::format("--leaf {}: only a photo, a drawing or a scan holds several leaves; a mesh or a JSON "
                    "outline is one",
                    options.nth));
  if (!photo && (options.mm_per_pixel || options.threshold || !options.mask.empty()))
    throw Error(ErrorCode::configuration, "--mm-per-pixel, --threshold and --mask go with a photo");
  if (options.scan && (outline || photo))
    throw Error(ErrorCode::configuration, "--scan goes with a mesh or a point cloud");
  if (options.mm_per_unit && !scan)
    throw Error(ErrorCode::configuration, "--mm-per-unit goes with a scan; meshes are in metres");
  require_positive("--mm-per-pixel", options.mm_per_pixel, 1e6);
  require_positive("--mm-per-unit", options.mm_per_unit, 1e9);
  require_positive("--threshold", options.threshold, 100.0);
}

// A .ply without faces is a scan too.
Leaf read_mesh_or_scan(const std::filesystem::path& file, const std::string& name, const ReadOptions& options,
                       const Monitor& monitor) {
  std::vector<std::string> notes;
  const detail::TriangleSoup soup = detail::read_mesh_file(file, notes);
  if (!options.scan && soup.faces.rows() > 0)
    return detail::leaf_from_mesh(soup, name, std::move(notes), options, monitor);
  return detail::leaf_from_scan({soup.positions, true, std::move(notes)}, name, options, monitor);
}

Leaf read(const std::filesystem::path& file, const std::string& extension, const ReadOptions& options,
          const Monitor& monitor) {
  const std::string name = file.stem().string();
  if (extension == ".svg")
    return detail::leaf_from_outline(detail::read_svg_outline(file, options.nth), name, options, monitor);
  if (extension == ".json")
    return detail::leaf_from_outline(detail::read_json_outline(file), name, options, monitor);
  if (is_photo(extension)) return detail::read_photo_leaf(file, options, monitor);
  if (is_points_file(extension)) {
    detail::Scan scan;
    scan.points = detail::read_points(file, scan.notes);
    return detail::leaf_from_scan(std::move(scan), name, options, monitor);
  }
  return read_mesh_or_scan(file, name, options, monitor);
}

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

const std::vector<std::string>& leaf_file_extensions() {
  static const std::vector<std::string> extensions{".obj", ".ply",  ".stl", ".glb", ".gltf", ".svg", ".json",
                                                   ".jpg", ".jpeg", ".png", ".xyz", ".txt",  ".csv"};
  return extensions;
}

Leaf read_leaf(const std::filesystem::path& file, const ReadOptions& options, const Monitor& monitor) {
  const std::string extension = extension_of(file);
  const std::string name = file.filename().string();
  if (!one_of(extension, leaf_file_extensions()))
    throw Error(ErrorCode::input,
                fmt::format("'{}': '{}' is no kind of leaf file{}; allowed are {}", name, extension,
                            did_you_mean(extension, leaf_file_extensions()), joined(leaf_file_extensions())));
  validate(options, extension);
  if (!std::filesystem::is_regular_file(file))
    throw Error(ErrorCode::input, fmt::format("'{}' does not exist or is no file", file.string()));
  Leaf leaf;
  try {
    leaf = read(file, extension, options, monitor);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input || std::string(error.what()).rfind("'" + name + "'", 0) == 0) throw;
    throw Error(ErrorCode::input, fmt::format("'{}': {}", name, error.what()));
  }
  for (const std::string& note : leaf.notes) monitor.say(note);
  return leaf;
}

int count_leaves(const std::filesystem::path& file, const ReadOptions& options) {
  return is_photo(extension_of(file)) ? detail::count_photo_leaves(file, options) : 1;
}

}  // namespace wilt
