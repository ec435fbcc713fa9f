// wilt info: what is in a leaf or result file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "load_leaf.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/file.hpp"
#include "wilt/output/gltf.hpp"

namespace wilt::cli {
namespace {

using Json = nlohmann::ordered_json;

Json describe_result(const GlbFile& file) {
  Json json = {{"kind", "wilt result"},         {"generator", file.generator},
               {"frames", file.times.size()},   {"seconds", file.times.empty() ? 0.0 : file.times.back()},
               {"iterations", file.iterations}, {"veins", file.veins.size()}};
  for (const GlbMesh& mesh : file.meshes)
    json["meshes"].push_back({{"name", mesh.name},
                              {"vertices", mesh.frames.front().rows()},
                              {"faces", mesh.faces.rows()},
                              {"has_uv", mesh.uv.rows() > 0},
                              {"has_water", mesh.water.size() > 0}});
  const Json extras = Json::parse(file.extras, nullptr, false);
  if (extras.contains("config")) json["config"] = extras["config"];
  return json;
}

Json describe_leaf(const std::string& path, const Monitor& monitor) {
  const Leaf leaf = read_leaf(path, {}, monitor);
  return {{"kind", "leaf"},
          {"name", leaf.name},
          {"vertices", leaf.mesh.num_vertices()},
          {"faces", leaf.mesh.num_faces()},
          {"holes", leaf.mesh.boundary_loops().size() - 1},
          {"length_m", leaf_length(leaf)},
          {"area_m2", surface_area(leaf.mesh, leaf.positions)},
          {"petiole_vertex", static_cast<int>(leaf.petiole)},
          {"stalk", leaf.stalk.centreline.rows() > 0},
          {"notes", leaf.notes}};
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_text(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    if (key == "config" || key == "iterations") continue;
    if (value.is_array()) {
      for (const Json& item : value) fmt::print("{:<16}{}\n", key, plain(item));
    } else {
      fmt::print("{:<16}{}\n", key, plain(value));
    }
  }
}

bool is_wilt_result(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".glb") return false;
  try {
    return !parse_glb(read_file(path), path).extras.empty();
  } catch (const Error&) {
    return false;  // another program's GLB: a leaf, perhaps
  }
}

void run(const std::string& path, const GlobalOptions& options) {
  if (!std::filesystem::exists(path))
    throw Error(ErrorCode::input, fmt::format("there is no file '{}'", path));
  Terminal terminal(options);
  const Json json =
      is_wilt_result(path) ? describe_result(read_glb(path)) : describe_leaf(path, terminal.monitor());
  if (options.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    print_text(json);
  }
}

}  // namespace

void add_info(CLI::App& app, const GlobalOptions& options) {
  const auto path = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("info",
                                      "What is in a leaf or result file\n\n"
                                      "Examples:\n"
                                      "  wilt info maple.glb\n"
                                      "  wilt info drawing.svg --json\n");
  verb->add_option("FILE", *path, "A result (.glb), a mesh or an outline")->required();
  verb->callback([path, &options] { run(*path, options); });
}

}  // namespace wilt::cli
