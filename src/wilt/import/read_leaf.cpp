#include "wilt/import/read_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/core/printable.hpp"
#include "wilt/import/content_kind.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/mesh_leaf.hpp"
#include "wilt/import/photo_file.hpp"
#include "wilt/import/photo_leaf.hpp"
#include "wilt/import/reading.hpp"
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
  detail::validate_size_and_petiole(options);
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
Leaf leaf_from_mesh_or_scan(const std::filesystem::path& file, std::string_view bytes,
                            const std::string& name, const ReadOptions& options, const Monitor& monitor) {
  detail::TriangleSoup soup = detail::read_mesh(bytes, extension_of(file.string()),
                                                file.has_parent_path() ? file.parent_path() : ".", monitor);
  if (!options.scan && soup.faces.rows() > 0) return detail::leaf_from_mesh(soup, name, options, monitor);
  return detail::leaf_from_scan({soup.positions, true, std::move(soup.notes)}, name, options, monitor);
}

// The largest file of a kind that is read, bytes: what is parsed takes some 20 times as much memory.
std::uint64_t largest(const std::string& extension) {
  if (extension == ".json") return std::uint64_t{64} << 20;
  if (extension == ".svg") return std::uint64_t{256} << 20;
  return is_photo(extension) ? detail::kLargestPicture : kLargestFile;
}

// The bytes of a leaf file; pipes and devices have no end that could be trusted.
std::string bytes_of(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown))
    throw Error(ErrorCode::input, fmt::format("'{}' does not exist or is no file", file.string()));
  return read_file(file.string(), largest(extension_of(file.string())));
}

Leaf parse(const std::filesystem::path& file, std::string_view bytes, const ReadOptions& options,
           const Monitor& monitor) {
  const std::string name = printable(file.stem().string()), extension = extension_of(file.string());
  if (extension == ".svg")
    return detail::leaf_from_outline(detail::read_svg_outline(bytes, options.nth, monitor), name, options,
                                     monitor);
  if (extension == ".json")
    return detail::leaf_from_outline(parse_json_outline(bytes), name, options, monitor);
  if (is_photo(extension)) return detail::leaf_from_photo(bytes, name, options, monitor);
  if (is_points_file(extension)) {
    detail::Scan scan;
    scan.points = detail::parse_points(bytes, scan.notes);
    return detail::leaf_from_scan(std::move(scan), name, options, monitor);
  }
  return leaf_from_mesh_or_scan(file, bytes, name, options, monitor);
}

Leaf read(const std::filesystem::path& file, const ReadOptions& options, const Monitor& monitor) {
  const std::string bytes = bytes_of(file);
  if (bytes.empty()) throw Error(ErrorCode::input, "it is empty; write it again");
  try {
    return parse(file, bytes, options, monitor);
  } catch (const Error& error) {
    const std::string hint = detail::wrong_kind_hint(bytes, extension_of(file.string()));
    if (error.code() != ErrorCode::input || hint.empty()) throw;
    throw Error(ErrorCode::input, error.what() + hint);
  }
}

}  // namespace

const std::vector<std::string>& leaf_file_extensions() {
  static const std::vector<std::string> extensions{".obj", ".ply",  ".stl", ".glb", ".gltf", ".svg", ".json",
                                                   ".jpg", ".jpeg", ".png", ".xyz", ".txt",  ".csv"};
  return extensions;
}

Leaf read_leaf(const std::filesystem::path& file, const ReadOptions& options, const Monitor& monitor) {
  const std::string extension = extension_of(file.string());
  if (!one_of(extension, leaf_file_extensions()))
    throw Error(ErrorCode::input,
                fmt::format("'{}': '{}' is no kind of leaf file{}; allowed are {}", file.filename().string(),
                            extension, did_you_mean(extension, leaf_file_extensions()),
                            joined(leaf_file_extensions())));
  validate(options, extension);
  Leaf leaf = detail::naming(file.filename().string(), [&] { return read(file, options, monitor); });
  detail::check_length(leaf, file.filename().string());
  for (const std::string& note : leaf.notes) monitor.say(note);
  return leaf;
}

int count_leaves(const std::filesystem::path& file, const ReadOptions& options) {
  if (!is_photo(extension_of(file.string()))) return 1;
  return detail::naming(file.filename().string(),
                        [&] { return detail::count_photo_leaves(bytes_of(file), options); });
}

}  // namespace wilt
