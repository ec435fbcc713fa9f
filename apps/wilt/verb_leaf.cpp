// wilt leaf: the leaf as a mesh.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "leaf_options.hpp"
#include "plan.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/run/result_formats.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/simulation/senescence.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt::cli {
namespace {

struct Request {
  LeafRequest leaf;
  bool all_leaves = false;
  std::string output;
  bool dry_run = false;
};

// The files carry the fresh texture, whose veins have to be found; a blade where there are none is of one
// colour.
void write_leaf(const std::string& path, const Leaf& leaf, Terminal& terminal) {
  const std::vector<Frame> frames = rest_frames(leaf);
  const auto write = [&path](const Clip& clip) {
    if (extension_of(path) == ".glb") return write_glb(path, clip);
    write_obj(path, ShownColours(clip), 0);
  };
  const Species& kind = species(leaf.species);
  const Config config = default_config(kind);
  Venation venation;
  try {
    venation = find_venation(leaf, kind.secondary, venation_options(config), terminal.monitor());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input) throw;
    terminal.warn(fmt::format("no texture: {}", error.what()));
    Clip clip{leaf, frames};
    const Vec3 fresh = TissueColours(kind.pigments)({});
    clip.colours.push_back(fresh.transpose().replicate(leaf.positions.rows(), 1));
    clip.stalk_colours.push_back(linear_rgb(kind.pigments.stalk));
    return write(clip);
  }
  write(make_clip(leaf, venation, config, frames));
}

void run(const Request& request, const GlobalOptions& options) {
  const std::string extension = extension_of(request.output);
  if (!request.output.empty() && extension != ".glb" && extension != ".obj")
    throw Error(ErrorCode::configuration,
                fmt::format("cannot write '{}': a leaf is .glb or .obj", request.output));
  if (request.output.empty() && !options.json)
    throw Error(ErrorCode::configuration, "nothing would be written; add -o leaf.glb");
  const std::vector<std::string> outputs(request.output.empty() ? 0 : 1, request.output);
  check_results(outputs, {}, 1);
  Terminal terminal(options);
  if (request.dry_run) {
    const int vertices = planned_vertices(request.leaf, terminal.monitor());
    return print_plan(fmt::format("mesh {}: {} vertices", request.leaf.leaf, vertices),
                      {{"leaf", request.leaf.leaf}, {"vertices", vertices}}, result_files(outputs, 1),
                      options);
  }
  const Leaf leaf = load_leaf(request.leaf, terminal.monitor());
  const double angle = smallest_angle(leaf.mesh, leaf.positions) * 180.0 / std::numbers::pi;
  terminal.say(fmt::format("{}: {} vertices, {} faces, {:.0f} mm, smallest angle {:.0f} degrees", leaf.name,
                           leaf.mesh.num_vertices(), leaf.mesh.num_faces(), 1e3 * leaf_length(leaf), angle));
  if (!request.output.empty()) {
    write_leaf(request.output, leaf, terminal);
    terminal.say("wrote " + request.output);
  }
  if (!options.json) return;
  const nlohmann::ordered_json json = {{"name", leaf.name},
                                       {"species", leaf.species},
                                       {"vertices", leaf.mesh.num_vertices()},
                                       {"faces", leaf.mesh.num_faces()},
                                       {"length_m", leaf_length(leaf)},
                                       {"area_m2", surface_area(leaf.mesh, leaf.positions)},
                                       {"smallest_angle_deg", angle},
                                       {"petiole_vertex", static_cast<int>(leaf.petiole)},
                                       {"notes", leaf.notes}};
  print_data(json.dump(2) + "\n");
}

}  // namespace

void add_leaf(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("leaf",
                         "The leaf as a mesh\n\n"
                         "Examples:\n"
                         "  wilt leaf grape -o grape.glb --vertices 5000 --seed 7\n"
                         "  wilt leaf photo.jpg -o leaf.glb --mm-per-pixel 0.1\n"
                         "  wilt leaf photo.jpg --leaf all -o leaf.glb          leaf-1.glb, leaf-2.glb ...\n"
                         "  wilt leaf drawing.svg -o leaf.obj\n"
                         "  wilt leaf blade.obj -o even.glb --vertices 3000     remeshed\n"
                         "  wilt leaf scan.xyz -o leaf.glb                      a point cloud\n"
                         "  wilt leaf ragged.ply --scan -o leaf.glb             a scanned mesh\n");
  add_leaf_options(*verb, request->leaf, request->all_leaves);
  verb->add_option("-o,--output", request->output, ".glb or .obj")->type_name("FILE");
  add_dry_run(*verb, request->dry_run);
  verb->callback([request, &options] {
    for_each_leaf(request->leaf, request->all_leaves, [&](const LeafRequest& leaf, const auto& name) {
      Request one = *request;
      one.leaf = leaf;
      one.output = name(one.output);
      run(one, options);
    });
  });
}

}  // namespace wilt::cli
