#include "load_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "arguments.hpp"
#include "checks.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt::cli {
namespace {

constexpr std::uint64_t kLargestVeins = std::uint64_t{256} << 20;  // bytes

bool looks_like_a_file(const std::string& leaf) {
  return std::filesystem::path(leaf).has_extension() || leaf.find('/') != std::string::npos;
}

CLI::Validator number_or_all() {
  const auto number = whole_number(1, 10000);
  const auto check = [number](const std::string& text) -> std::string {
    const std::string refusal = text == "all" ? "" : number(text);
    return refusal.empty() ? "" : refusal + "; or all";
  };
  return {check, ""};
}

ReadOptions read_options(const LeafRequest& request) {
  ReadOptions options;
  options.vertices = request.vertices;
  options.seed = request.seed;
  options.nth = request.which == "all" ? 1 : std::stoi(request.which);
  options.mm_per_pixel = request.mm_per_pixel;
  options.mask = request.mask;
  options.threshold = request.threshold;
  options.scan = request.scan;
  options.mm_per_unit = request.mm_per_unit;
  if (!request.petiole.empty())
    options.petiole = parse_pair(request.petiole, ',', "--petiole takes two numbers, X,Y");
  return options;
}

}  // namespace

void add_leaf_options(CLI::App& verb, LeafRequest& request) {
  verb.add_option("LEAF", request.leaf,
                  "A species (maple poplar tilia ivy willow grape), a photo (.jpg .png),\n"
                  "a mesh (.obj .ply .stl .glb .gltf), an outline (.svg .json)\n"
                  "or a scan (.xyz .txt .csv, .ply without faces)")
      ->required()
      ->check(offers(species_names()))
      ->type_name("FILE");
  verb.add_option("--vertices", request.vertices,
                  "Vertices of the mesh, 200 to 1000000 (2000, of a photo 5000;\na mesh file keeps its own)")
      ->check(whole_number(200, 1000000))
      ->type_name("N");
  verb.add_option("--seed", request.seed, "Varies the individual leaf (1)")
      ->check(whole_number(0, kMostSeed))
      ->type_name("N");
  verb.add_option("--petiole", request.petiole,
                  "Where the stalk meets the blade: pixels of a photo, units of a file")
      ->type_name("X,Y");
  verb.add_option(
          "--leaf", request.which,
          "Take the N-th largest leaf of a photo, drawing or scan (1),\nor all of a photo: leaf-1.glb, "
          "leaf-2.glb ...")
      ->check(number_or_all())
      ->type_name("N");
  verb.add_option("--mm-per-pixel", request.mm_per_pixel, "Scale of a photo (else 100 mm across)")
      ->check(number(1e-6, 1e6))
      ->type_name("MM");
  verb.add_option("--mask", request.mask, "A picture of the photo's shape, white where the leaf is")
      ->type_name("FILE");
  verb.add_option("--threshold", request.threshold,
                  "Colour difference at which a photo's leaf begins, 0 to 100 (found)")
      ->check(number(0.0, 100.0))
      ->type_name("X");
  verb.add_flag("--scan", request.scan,
                "Take the vertices of a mesh as the points of a scan: clean and fit them");
  verb.add_option("--mm-per-unit", request.mm_per_unit,
                  "Unit of a scan (1 mm, or 1 m for a blade below 2 units)")
      ->check(number(1e-9, 1e9))
      ->type_name("MM");
}

bool is_species(const std::string& leaf) {
  const auto& names = species_names();
  return std::find(names.begin(), names.end(), leaf) != names.end();
}

Leaf load_leaf(const LeafRequest& request, const Monitor& monitor) {
  if (is_species(request.leaf)) {
    if (!request.petiole.empty() || request.which != "1" || !request.mask.empty() || request.mm_per_pixel ||
        request.threshold || request.scan || request.mm_per_unit)
      throw Error(ErrorCode::configuration,
                  "--petiole, --leaf and the options of photos and scans go with a file; a species has its "
                  "petiole");
    return make_leaf(request.leaf, request.vertices.value_or(kDefaultVertices), request.seed, monitor);
  }
  std::error_code unknown;  // of a symbolic link to itself, say
  if (!std::filesystem::exists(request.leaf, unknown)) {
    if (looks_like_a_file(request.leaf))
      throw Error(ErrorCode::input, fmt::format("there is no file '{}'; check the path", request.leaf));
    throw Error(ErrorCode::input,
                fmt::format("'{}' is neither a species ({}) nor a file{}", request.leaf,
                            fmt::join(species_names(), ", "), did_you_mean(request.leaf, species_names())));
  }
  return read_leaf(request.leaf, read_options(request), monitor);
}

void for_each_leaf(
    const LeafRequest& request,
    const std::function<void(const LeafRequest& leaf,
                             const std::function<std::string(const std::string&)>& name)>& run) {
  std::error_code unknown;
  const bool all = request.which == "all" && std::filesystem::is_regular_file(request.leaf, unknown);
  if (!all) return run(request, [](const std::string& path) { return path; });
  if (!request.petiole.empty() || !request.veins.empty())
    throw Error(ErrorCode::configuration,
                "--petiole and --veins are one leaf's; give --leaf N instead of all");
  LeafRequest one = request;
  one.which = "1";
  const int count = count_leaves(request.leaf, read_options(one));
  for (int n = 1; n <= count; ++n) {
    one.which = std::to_string(n);
    run(one, [n](const std::string& path) {
      if (path.empty()) return path;
      const std::size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
      const std::size_t dot = std::min(path.find('.', name), path.size());
      return fmt::format("{}-{}{}", path.substr(0, dot), n, path.substr(dot));
    });
  }
}

void add_veins_option(CLI::App& verb, LeafRequest& request) {
  verb.add_option(
          "--veins", request.veins,
          "Veins from a veins.json that `wilt veins` wrote for this leaf,\nedited: moved, deleted, added")
      ->type_name("FILE");
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

}  // namespace wilt::cli
