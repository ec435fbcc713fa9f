#include "wilt/run/leaf_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

constexpr std::uint64_t kLargestVeins = std::uint64_t{256} << 20;  // bytes

bool looks_like_a_file(const std::string& leaf) {
  return std::filesystem::path(leaf).has_extension() || leaf.find('/') != std::string::npos;
}

void refuse_options_of_files(const ReadOptions& read) {
  if (read.nth != 1 || !read.mask.empty() || read.mm_per_pixel || read.threshold || read.scan ||
      read.mm_per_unit)
    throw Error(ErrorCode::configuration,
                "--leaf and the options of photos and scans go with a file, not with a species");
}

}  // namespace

bool is_species(const std::string& leaf) {
  const auto& names = species_names();
  return std::find(names.begin(), names.end(), leaf) != names.end();
}

void take_size_and_seed(LeafRequest& request, const Config& config) {
  request.read.seed = static_cast<std::uint64_t>(config.seed);
  if (config.vertices > 0) request.read.vertices = static_cast<int>(config.vertices);
}

Leaf load_leaf(const LeafRequest& request, const Monitor& monitor) {
  if (is_species(request.leaf)) {
    refuse_options_of_files(request.read);
    Leaf leaf =
        make_leaf(request.leaf, request.read.vertices.value_or(kDefaultVertices), request.read.seed, monitor);
    constexpr double kMetres = 0.001;
    return request.read.petiole ? with_petiole(std::move(leaf), kMetres * *request.read.petiole) : leaf;
  }
  std::error_code unknown;  // of a symbolic link to itself, say
  if (!std::filesystem::exists(request.leaf, unknown)) {
    if (looks_like_a_file(request.leaf))
      throw Error(ErrorCode::input, fmt::format("there is no file '{}'; check the path", request.leaf));
    throw Error(ErrorCode::input,
                fmt::format("'{}' is neither a species ({}) nor a file{}", request.leaf,
                            fmt::join(species_names(), ", "), did_you_mean(request.leaf, species_names())));
  }
  return read_leaf(request.leaf, request.read, monitor);
}

Venation load_veins(const LeafRequest& request, const Leaf& leaf, const SecondaryVeinRule& rule,
                    const VenationOptions& options, const Monitor& monitor) {
  Venation found = find_venation(leaf, rule, options, monitor);
  if (request.veins.empty()) return found;
  const std::string text = read_file(request.veins, kLargestVeins);
  try {
    return with_drawn_veins(leaf, found, parse_veins_json(text, request.veins, leaf, found), options);
  } catch (const Error& error) {
    if (std::string_view(error.what()).find(request.veins) != std::string_view::npos) throw;
    throw Error(error.code(), fmt::format("'{}': {}", request.veins, error.what()));
  }
}

}  // namespace wilt
