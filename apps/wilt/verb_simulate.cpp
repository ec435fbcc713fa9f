// wilt simulate: a leaf in, a withered leaf out.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "checks.hpp"
#include "interrupts.hpp"
#include "leaf_options.hpp"
#include "plan.hpp"
#include "run.hpp"
#include "settings_list.hpp"
#include "verbs.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/run/result_files.hpp"
#include "wilt/run/result_formats.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "writing.hpp"

namespace wilt::cli {
namespace {

constexpr std::uint64_t kLargestConfig = std::uint64_t{1} << 20;  // bytes

struct Request {
  LeafRequest leaf;
  bool all_leaves = false;
  std::vector<std::string> outputs, assignments;
  std::string model, config_file, report, forces;
  std::optional<std::int64_t> iterations, frames;
  FileOptions files;
  CheckpointOptions checkpoint;
  int threads = 0;
  bool print_config = false, dry_run = false;
};

// What --set may begin with.
std::vector<std::string> assignments() {
  std::vector<std::string> words;
  for (const Setting& setting : settings()) words.push_back(setting.key + "=");
  return words;
}

// What the options say of the settings; --set comes last and wins.
std::vector<Assignment> assigned(const Request& request, bool seed_given) {
  std::vector<Assignment> list;
  const auto number = [&list](const char* key, auto value) {
    if (value) list.push_back({key, std::to_string(*value)});
  };
  if (!request.model.empty()) list.push_back({"model", request.model});
  number("vertices", request.leaf.read.vertices);
  if (seed_given) list.push_back({"seed", std::to_string(request.leaf.read.seed)});
  number("iterations", request.iterations);
  number("frames", request.frames);
  for (const std::string& assignment : request.assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos)
      throw Error(ErrorCode::configuration, fmt::format("--set takes key=value, not '{}'", assignment));
    list.push_back({assignment.substr(0, equals), assignment.substr(equals + 1)});
  }
  return list;
}

Config configure(const Request& request, bool seed_given) {
  const std::string file = request.config_file.empty() ? "" : read_file(request.config_file, kLargestConfig);
  return resolve_config(is_species(request.leaf.leaf) ? request.leaf.leaf : "generic", file,
                        request.config_file, assigned(request, seed_given));
}

void summarise(const WitheredLeaf& withered, Terminal& terminal) {
  const FrameMetrics& m = withered.result.metrics.back();
  double halved = 0;
  for (const StepRow& step : withered.result.steps) halved += step.dt < withered.config.dt ? 1 : 0;
  terminal.say(
      fmt::format("after {} iterations: wrinkle {:.4f} of the length, curl {:.0f} degrees, area {:.0f} %, "
                  "largest strain {:.0f} %, self-intersections {}",
                  m.iteration, m.wrinkle, m.curl * 180.0 / std::numbers::pi, 100.0 * m.area_ratio,
                  100.0 * m.max_strain, m.self_intersections));
  if (halved > 0) terminal.detail(fmt::format("{} steps were halved", halved));
  const Timings& t = withered.timings;
  terminal.detail(
      fmt::format("seconds: leaf {:.2f}, geodesics {:.2f}, embedding {:.2f}, venation {:.2f}, simulation "
                  "{:.2f}, output {:.2f}",
                  t.leaf, t.geodesics, t.embedding, t.venation, t.simulation, t.output));
}

// The files that are not results.
std::vector<std::string> figures(const Request& request) {
  std::vector<std::string> paths;
  for (const std::string& path : {request.report, request.forces, request.checkpoint.file}) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

void plan(const Request& request, const Config& config, const GlobalOptions& options, Terminal& terminal) {
  const Checkpoints can_be_used(request.checkpoint, terminal);
  const int vertices = planned_vertices(request.leaf, terminal.monitor());
  const nlohmann::ordered_json facts = {{"leaf", request.leaf.leaf},
                                        {"species", config.species},
                                        {"vertices", vertices},
                                        {"model", config.model},
                                        {"iterations", config.iterations},
                                        {"frames", std::min(config.frames, config.iterations + 1)}};
  std::vector<std::string> files = result_files(request.outputs, static_cast<int>(config.frames));
  for (const std::string& path : figures(request)) files.push_back(path);
  print_plan(
      fmt::format("wither {}: {} vertices, {} iterations of the model '{}', {} frames", request.leaf.leaf,
                  vertices, config.iterations, config.model, facts["frames"].get<int>()),
      facts, files, options);
}

// Returns what kept it from writing all of them.
std::optional<Error> write_all(const Request& request, WitheredLeaf& withered, Terminal& terminal) {
  const auto start = std::chrono::steady_clock::now();
  if (withered.result.interrupted) go_on_after_interrupt();
  ResultFiles files(withered, terminal.monitor(), request.files);
  Writing writing(terminal);
  for (const std::string& output : request.outputs)
    writing.file(output, [&](const std::string& path) { files.write(path); });
  writing.file(request.forces,
               [&](const std::string& path) { write_file(path, forces_csv(withered.result)); });
  withered.timings.output = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writing.file(request.report, [&](const std::string& path) { write_file(path, report_of(withered)); });
  return writing.failure();
}

void run(Request& request, bool seed_given, const GlobalOptions& options) {
  const Config config = configure(request, seed_given);
  take_size_and_seed(request.leaf, config);
  if (request.print_config) {
    print_data(options.json ? settings_json(config) : to_toml(config, true));
    return;
  }
  if (request.leaf.leaf.empty())
    throw Error(ErrorCode::configuration, "which leaf? see `wilt simulate --help`");
  if (request.outputs.empty() && request.report.empty() && request.forces.empty() && !options.json)
    throw Error(ErrorCode::configuration,
                fmt::format("nothing would be written; add -o {}.glb",
                            std::filesystem::path(request.leaf.leaf).stem().string()));
  check_results(request.outputs, figures(request), static_cast<int>(config.frames));
  const ThreadLimit limit(request.threads);
  Terminal terminal(options);
  if (request.dry_run) return plan(request, config, options, terminal);
  WitheredLeaf withered = wither(request.leaf, config, terminal, request.checkpoint);
  const std::optional<Error> unwritten = write_all(request, withered, terminal);
  summarise(withered, terminal);
  if (options.json) print_data(report_of(withered) + "\n");
  const SimulationResult& result = withered.result;
  if (result.completed) {
    if (unwritten) throw *unwritten;
    return;
  }
  if (unwritten) throw Error(unwritten->code(), fmt::format("{}; {}", result.stop_reason, unwritten->what()));
  std::string message = result.stop_reason + "; what was computed until then was written";
  if (result.interrupted && !request.checkpoint.file.empty())
    message += "; the same command with --resume goes on";
  if (!result.interrupted)
    message += fmt::format("; try a smaller time step (--set dt={}) or milder settings", config.dt / 2);
  throw Error(result.interrupted ? ErrorCode::interrupted : ErrorCode::simulation, message);
}

}  // namespace

void add_simulate(CLI::App& app, const GlobalOptions& options) {
  const auto request = std::make_shared<Request>();
  CLI::App* verb = app.add_subcommand(
      "simulate",
      "Withers a leaf and writes it\n\n"
      "Examples:\n"
      "  wilt simulate maple -o maple.glb\n"
      "  wilt simulate photo.jpg -o mine.glb -o mine.png\n"
      "  wilt simulate drawing.svg -o mine.glb -o mine.png --report report.json\n"
      "  wilt simulate maple -o maple.usda -o maple.pvd -o 'frames/maple.####.obj'   USD, ParaView, a file "
      "per frame\n"
      "  wilt simulate maple -o maple.obj -o maple.mdd        a mesh, and a cache that moves it\n"
      "  wilt simulate grape -o dry.glb --set water.humidity=0.2 --set water.temperature_c=35\n"
      "  wilt simulate drawing.svg -o mine.glb --veins veins.json    veins edited by hand\n"
      "  wilt simulate ivy -o ivy.glb --model paper --forces forces.csv\n"
      "  wilt simulate maple -o big.glb --vertices 200000 --checkpoint big.checkpoint --resume\n"
      "                                                      goes on where it was killed\n"
      "  wilt simulate maple --print-config > run.toml    then edit it, and give it back:\n"
      "  wilt simulate maple -o maple.glb --config run.toml\n");
  add_leaf_options(*verb, request->leaf, request->all_leaves);
  add_veins_option(*verb, request->leaf);
  verb->get_option("LEAF")->required(false);
  const CLI::Option* seed = verb->get_option("--seed");
  verb->add_option("-o,--output", request->outputs,
                   "Result; repeatable. By the end of its name:" + result_formats_help())
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb->add_option("--iterations", request->iterations, "Time steps (100)")
      ->check(whole_number(0, 1000000))
      ->type_name("N");
  verb->add_option("--frames", request->frames, "Frames in the clip (26)")
      ->check(whole_number(2, 100000))
      ->type_name("N");
  verb->add_option("--max-morphs", request->files.max_morphs,
                   "Frames in a .glb (all): those whose playback misses the least")
      ->type_name("N")
      ->check(whole_number(2, 100000));
  verb->add_option("--lods", request->files.lods, "Coarser meshes beside a .vat.json (0)")
      ->type_name("N")
      ->check(whole_number(0, 8));
  verb->add_option_function<std::string>(
          "--vat", [request](const std::string& kind) { request->files.vat_png = kind == "png"; },
          "Textures of a .vat.json: exr (half floats) or png (16 bits)")
      ->type_name("KIND")
      ->check(one_of({"exr", "png"}));
  verb->add_option("--model", request->model, "cell (default) or paper")
      ->check(one_of(model_names()))
      ->type_name("NAME");
  verb->add_option("--config", request->config_file, "Settings from a TOML file")->type_name("FILE");
  verb->add_option("--set", request->assignments, "One setting; repeatable, wins over --config")
      ->check(offers(assignments()))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--print-config", request->print_config,
                 "List the settings with unit, default and range, and stop");
  add_dry_run(*verb, request->dry_run);
  verb->add_option("--report", request->report, "Steps, metrics, timings as JSON")->type_name("FILE");
  verb->add_option("--forces", request->forces, "Forces by region and iteration as CSV")->type_name("FILE");
  verb->add_option("--checkpoint", request->checkpoint.file,
                   "Keep the state of the run there, to go on after a kill or Ctrl-C")
      ->type_name("FILE");
  verb->add_flag("--resume", request->checkpoint.resume,
                 "Go on from --checkpoint; results are as if never left");
  verb->add_option("--checkpoint-every", request->checkpoint.every, "Seconds between checkpoints (10)")
      ->type_name("S")
      ->check(number(0.0, 86400.0));
  verb->add_option("--threads", request->threads, "Threads at most (all); results do not depend on it")
      ->type_name("N")
      ->check(whole_number(0, 1024));
  verb->callback([request, seed, &options] {
    for_each_leaf(request->leaf, request->all_leaves, [&](const LeafRequest& leaf, const auto& name) {
      Request one = *request;
      one.leaf = leaf;
      for (std::string& path : one.outputs) path = name(path);
      one.report = name(one.report);
      one.forces = name(one.forces);
      one.checkpoint.file = name(one.checkpoint.file);
      run(one, seed->count() > 0, options);
    });
  });
}

}  // namespace wilt::cli
