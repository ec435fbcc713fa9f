#include "plan.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "wilt/core/file.hpp"

namespace wilt::cli {

void add_dry_run(CLI::App& verb, bool& dry_run) {
  verb.add_flag("--dry-run", dry_run, "Check everything, say what would be computed and written, and stop");
}

void print_plan(const std::string& deed, nlohmann::ordered_json facts, const std::vector<std::string>& files,
                const GlobalOptions& options) {
  std::string text = "would " + deed + "\n";
  facts["files"] = nlohmann::ordered_json::array();
  for (const std::string& file : files) {
    const bool is_old = std::filesystem::exists(file);
    facts["files"].push_back({{"file", file}, {"replaces", is_old}});
    text += fmt::format("would {} {}\n", is_old ? "replace" : "write", file);
  }
  print_data(options.json ? facts.dump(2) + "\n" : text);
}

int planned_vertices(const LeafRequest& request, const Monitor& monitor) {
  constexpr int kQuick = 1000;  // meshed in no time
  LeafRequest quick = request;
  if (is_species(request.leaf) || request.read.vertices)
    quick.read.vertices = std::min(request.read.vertices.value_or(kQuick), kQuick);
  const Leaf leaf = load_leaf(quick, monitor);
  if (!request.veins.empty()) read_file(request.veins);
  if (is_species(request.leaf)) return request.read.vertices.value_or(kDefaultVertices);
  return request.read.vertices.value_or(leaf.mesh.num_vertices());
}

}  // namespace wilt::cli
