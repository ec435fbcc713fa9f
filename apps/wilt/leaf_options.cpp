#include "leaf_options.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "arguments.hpp"
#include "checks.hpp"
#include "wilt/core/error.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt::cli {
namespace {

CLI::Validator number_or_all() {
  const auto number = whole_number(1, 10000);
  const auto check = [number](const std::string& text) -> std::string {
    const std::string refusal = text == "all" ? "" : number(text);
    return refusal.empty() ? "" : refusal + "; or all";
  };
  return {check, ""};
}

}  // namespace

void add_leaf_options(CLI::App& verb, LeafRequest& request, bool& all) {
  ReadOptions& read = request.read;
  verb.add_option("LEAF", request.leaf,
                  "A species (maple poplar tilia ivy willow grape), a photo (.jpg .png),\n"
                  "a mesh (.obj .ply .stl .glb .gltf), an outline (.svg .json)\n"
                  "or a scan (.xyz .txt .csv, .ply without faces)")
      ->required()
      ->check(offers(species_names()))
      ->type_name("FILE");
  verb.add_option("--vertices", read.vertices,
                  "Vertices of the mesh, 200 to 1000000 (2000, of a photo 5000;\na mesh file keeps its own)")
      ->check(whole_number(200, 1000000))
      ->type_name("N");
  verb.add_option("--seed", read.seed, "Varies the individual leaf (1)")
      ->check(whole_number(0, kMostSeed))
      ->type_name("N");
  verb.add_option_function<std::string>(
          "--petiole",
          [&read](const std::string& text) {
            read.petiole = parse_pair(text, ',', "--petiole takes two numbers, X,Y");
          },
          "Where the stalk meets the blade: pixels of a photo, units of a\nfile, millimetres from a species' "
          "own petiole")
      ->type_name("X,Y");
  verb.add_option_function<std::string>(
          "--leaf",
          [&read, &all](const std::string& which) {
            all = which == "all";
            if (!all) read.nth = std::stoi(which);
          },
          "Take the N-th largest leaf of a photo, drawing or scan (1),\nor all of a photo: leaf-1.glb, "
          "leaf-2.glb ...")
      ->check(number_or_all())
      ->type_name("N");
  verb.add_option("--mm-per-pixel", read.mm_per_pixel, "Scale of a photo (else 100 mm across)")
      ->check(number(1e-6, 1e6))
      ->type_name("MM");
  verb.add_option_function<std::string>(
          "--mask", [&read](const std::string& file) { read.mask = file; },
          "A picture of the photo's shape, white where the leaf is")
      ->type_name("FILE");
  verb.add_option("--threshold", read.threshold,
                  "Colour difference at which a photo's leaf begins, 0 to 100 (found)")
      ->check(number(0.0, 100.0))
      ->type_name("X");
  verb.add_flag("--scan", read.scan,
                "Take the vertices of a mesh as the points of a scan: clean and fit them");
  verb.add_option("--mm-per-unit", read.mm_per_unit,
                  "Unit of a scan (1 mm, or 1 m for a blade below 2 units)")
      ->check(number(1e-9, 1e9))
      ->type_name("MM");
}

void for_each_leaf(
    const LeafRequest& request, bool all,
    const std::function<void(const LeafRequest& leaf,
                             const std::function<std::string(const std::string&)>& name)>& run) {
  if (all && is_species(request.leaf))
    throw Error(ErrorCode::configuration, "--leaf goes with a file; a species is one leaf");
  std::error_code unknown;
  if (!all || !std::filesystem::is_regular_file(request.leaf, unknown))
    return run(request, [](const std::string& path) { return path; });
  if (request.read.petiole || !request.veins.empty())
    throw Error(ErrorCode::configuration,
                "--petiole and --veins are one leaf's; give --leaf N instead of all");
  const int count = count_leaves(request.leaf, request.read);
  for (int n = 1; n <= count; ++n) {
    LeafRequest one = request;
    one.read.nth = n;
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

}  // namespace wilt::cli
