#include "load_leaf.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "arguments.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

constexpr int kDefaultVertices = 2000;

bool looks_like_a_file(const std::string& leaf) {
  return std::filesystem::path(leaf).has_extension() || leaf.find('/') != std::string::npos;
}

}  // namespace

void add_leaf_options(CLI::App& verb, LeafRequest& request) {
  verb.add_option("LEAF", request.leaf,
                  "A species (maple poplar tilia ivy willow grape), a mesh (.obj .ply .stl .glb .gltf),\n"
                  "an outline (.svg .json) or a scan (.xyz .txt .csv, .ply without faces)")
      ->required();
  verb.add_option("--vertices", request.vertices,
                  "Vertices of the mesh, 200 to 1000000 (2000; a mesh file keeps its own)")
      ->check(CLI::Range(200, 1000000))
      ->type_name("N");
  verb.add_option("--seed", request.seed, "Varies the individual leaf (1)")->type_name("N");
  verb.add_option("--petiole", request.petiole, "Where the stalk meets the blade, in the file's units")
      ->type_name("X,Y");
  verb.add_option("--leaf", request.nth, "Take the N-th largest leaf of a drawing or scan (1)")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  verb.add_flag("--scan", request.scan,
                "Take the vertices of a mesh as the points of a scan: clean and fit them");
  verb.add_option("--mm-per-unit", request.mm_per_unit,
                  "Unit of a scan (1 mm, or 1 m for a blade below 2 units)")
      ->type_name("MM");
}

bool is_species(const std::string& leaf) {
  const auto& names = species_names();
  return std::find(names.begin(), names.end(), leaf) != names.end();
}

Leaf load_leaf(const LeafRequest& request, const Monitor& monitor) {
  if (is_species(request.leaf)) {
    if (!request.petiole.empty() || request.nth != 1 || request.scan || request.mm_per_unit)
      throw Error(ErrorCode::configuration,
                  "--petiole, --leaf, --scan and --mm-per-unit go with a file; a species has its petiole");
    return make_leaf(request.leaf, request.vertices.value_or(kDefaultVertices), request.seed, monitor);
  }
  if (!std::filesystem::exists(request.leaf)) {
    if (looks_like_a_file(request.leaf))
      throw Error(ErrorCode::input, fmt::format("there is no file '{}'", request.leaf));
    throw Error(ErrorCode::input,
                fmt::format("'{}' is neither a species ({}) nor a file{}", request.leaf,
                            fmt::join(species_names(), ", "), did_you_mean(request.leaf, species_names())));
  }
  ReadOptions options;
  options.vertices = request.vertices;
  options.seed = request.seed;
  options.nth = request.nth;
  options.scan = request.scan;
  options.mm_per_unit = request.mm_per_unit;
  if (!request.petiole.empty())
    options.petiole = parse_pair(request.petiole, ',', "--petiole takes two numbers, X,Y");
  return read_leaf(request.leaf, options, monitor);
}

}  // namespace wilt::cli
