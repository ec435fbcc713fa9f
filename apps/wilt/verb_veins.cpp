// wilt veins: tips, primary and secondary veins.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "leaf_options.hpp"
#include "plan.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt::cli {
namespace {

struct Request {
  LeafRequest leaf;
  bool all_leaves = false;
  std::vector<std::string> outputs;
  bool dry_run = false;
};

void run(const Request& request, const GlobalOptions& options) {
  if (request.outputs.empty() && !options.json)
    throw Error(ErrorCode::configuration, "nothing would be written; add -o veins.svg");
  for (const std::string& path : request.outputs) {
    veins_writer(path);
    check_writable(path);
  }
  Terminal terminal(options);
  const Monitor monitor = terminal.monitor();
  if (request.dry_run) {
    const int vertices = planned_vertices(request.leaf, monitor);
    return print_plan(fmt::format("find the veins of {}: {} vertices", request.leaf.leaf, vertices),
                      {{"leaf", request.leaf.leaf}, {"vertices", vertices}}, request.outputs, options);
  }
  const Leaf leaf = load_leaf(request.leaf, monitor);
  const Venation venation = load_veins(request.leaf, leaf, species(leaf.species).secondary, {}, monitor);
  terminal.say(fmt::format("{}: {} tips, {} veins", leaf.name, venation.tips.size(), venation.veins.size()));
  for (const std::string& path : request.outputs) {
    write_file(path, veins_writer(path)(leaf, venation));
    terminal.say("wrote " + path);
  }
  if (options.json) print_data(veins_json(leaf, venation) + "\n");
}

}  // namespace

void add_veins(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("veins",
                         "Vein tips, primary and secondary veins\n\n"
                         "Examples:\n"
                         "  wilt veins maple -o veins.svg\n"
                         "  wilt veins drawing.svg -o veins.json -o veins.obj\n"
                         "  wilt veins drawing.svg --veins veins.json -o edited.svg    edited by hand\n");
  add_leaf_options(*verb, request->leaf, request->all_leaves);
  add_veins_option(*verb, request->leaf);
  verb->add_option("-o,--output", request->outputs, ".json, .svg or .obj; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_dry_run(*verb, request->dry_run);
  verb->callback([request, &options] {
    for_each_leaf(request->leaf, request->all_leaves, [&](const LeafRequest& leaf, const auto& name) {
      Request one = *request;
      one.leaf = leaf;
      for (std::string& path : one.outputs) path = name(path);
      run(one, options);
    });
  });
}

}  // namespace wilt::cli
