// wilt info: what is in a leaf or result file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/import/read_leaf.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/point_cache.hpp"

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

Json describe_cache(const std::string& path) {
  const PointCacheHead head = parse_point_cache(read_file(path), path);
  return {{"kind", "point cache"},
          {"vertices", head.points},
          {"frames", head.frames},
          {extension_of(path) == ".mdd" ? "seconds" : "scene_frames", head.length}};
}

// The text between the first `before` and the next `after`, or nothing.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + before.size(), end = text.find(after, from);
  return end == std::string::npos ? std::string() : text.substr(from, end - from);
}

// The number there, or null.
Json number_between(const std::string& text, const std::string& before, const std::string& after) {
  const Json number = Json::parse(between(text, before, after), nullptr, false);
  return number.is_number() ? number : Json();
}

// What the heads of the text files say that wilt wrote.
Json describe_text(const std::string& path) {
  const std::string text = read_file(path), extension = extension_of(path);
  const bool is_usd = extension == ".usda";
  const std::string writer =
      is_usd ? between(text, "\"wilt:version\" = \"", "\"") : between(text, "<!-- wilt ", ",");
  if (writer.empty())
    throw Error(ErrorCode::input,
                fmt::format("'{}' is not a file that wilt wrote; open it with the program that did", path));
  Json json = {{"kind", "wilt result"}, {"generator", "wilt " + writer}};
  if (is_usd) {
    json["leaf"] = between(text, "\"wilt:leaf\" = \"", "\"\n");
    json["time_codes"] = number_between(text, "endTimeCode = ", "\n");
    json["frame_rate"] = number_between(text, "timeCodesPerSecond = ", "\n");
  } else if (extension == ".vtu") {
    json["vertices"] = number_between(text, "NumberOfPoints=\"", "\"");
    json["faces"] = number_between(text, "NumberOfCells=\"", "\"");
    json["hours"] = number_between(text, "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">", "<");
  } else {
    int frames = 0;
    for (std::size_t at = text.find("part=\"0\""); at != std::string::npos;
         at = text.find("part=\"0\"", at + 1))
      ++frames;
    json["frames"] = frames;
    json["hours"] = number_between(text.substr(std::min(text.size(), text.rfind("timestep"))), "=\"", "\"");
  }
  return json;
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string text_of(const Json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (key == "config" || key == "iterations") continue;
    if (value.is_array()) {
      for (const Json& item : value) text += fmt::format("{:<16}{}\n", key, plain(item));
    } else {
      text += fmt::format("{:<16}{}\n", key, plain(value));
    }
  }
  return text;
}

bool is_wilt_result(const std::string& path) {
  if (extension_of(path) != ".glb") return false;
  try {
    return !parse_glb(read_file(path), path).extras.empty();
  } catch (const Error&) {
    return false;  // another program's GLB: a leaf, perhaps
  }
}

Json describe(const std::string& path, const Monitor& monitor) {
  const std::string extension = extension_of(path);
  if (extension == ".pc2" || extension == ".mdd") return describe_cache(path);
  if (extension == ".usda" || extension == ".vtu" || extension == ".pvd") return describe_text(path);
  if (is_wilt_result(path)) return describe_result(read_glb(path));
  return describe_leaf(path, monitor);
}

void run(const std::string& path, const GlobalOptions& options) {
  std::error_code unknown;  // of a symbolic link to itself, say
  if (!std::filesystem::exists(path, unknown))
    throw Error(ErrorCode::input, fmt::format("there is no file '{}'; check the path", path));
  if (!std::filesystem::is_regular_file(path))
    throw Error(ErrorCode::input, fmt::format("'{}' is a folder, a pipe or a device; give a file", path));
  Terminal terminal(options);
  const Json json = describe(path, terminal.monitor());
  print_data(options.json ? json.dump(2) + "\n" : text_of(json));
}

}  // namespace

void add_info(CLI::App& app, const GlobalOptions& options) {
  const auto path = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("info",
                                      "What is in a leaf or result file\n\n"
                                      "Examples:\n"
                                      "  wilt info maple.glb\n"
                                      "  wilt info drawing.svg --json\n");
  verb->add_option("FILE", *path, "A result (.glb .usda .pvd .vtu .pc2 .mdd), a mesh or an outline")
      ->required()
      ->type_name("FILE");
  verb->callback([path, &options] { run(*path, options); });
}

}  // namespace wilt::cli
