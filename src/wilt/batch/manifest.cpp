#include "wilt/batch/manifest.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "wilt/batch/item_files.hpp"
#include "wilt/core/file.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json parse_file(const fs::path& file) {
  return Json::parse(read_file(file.string()));
}

}  // namespace

void write_manifest(const Plan& plan, const fs::path& folder, const std::vector<ItemState>& states,
                    const Monitor& monitor) {
  std::string lines, sums;
  for (int item = 0; item < static_cast<int>(states.size()); ++item) {
    monitor.throw_if_cancelled();
    monitor.report("manifest", double(item) / double(states.size()));
    const std::string name = fmt::format("{:06}", item);
    if (states[static_cast<std::size_t>(item)] == ItemState::failed) {
      lines += parse_file(folder / "failed" / (name + ".json")).dump() + "\n";
      continue;
    }
    const std::string place = "items/" + name + "/";
    const Json labels = parse_file(folder / place / kItemLabels);
    Json line = {{"item", item},
                 {"folder", "items/" + name},
                 {"chosen", labels["chosen"]},
                 {"leaf", labels["leaf"]["name"]},
                 {"species", labels["leaf"]["species"]},
                 {"metrics", labels["metrics"]},
                 {"files", labels["files"]}};
    lines += line.dump() + "\n";
    for (const auto& [file, facts] : labels["files"].items())
      sums += fmt::format("{}  {}{}\n", facts["sha256"].get<std::string>(), place, file);
  }
  write_file((folder / "plan.toml").string(), plan.text());
  write_file((folder / "SHA256SUMS").string(), sums);
  write_file((folder / "manifest.jsonl").string(), lines);
}

}  // namespace wilt
