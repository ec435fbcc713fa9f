#include "wilt/batch/manifest.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "wilt/batch/item_files.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/file_writer.hpp"
#include "wilt/dataset/coco.hpp"
#include "wilt/dataset/webdataset.hpp"

namespace wilt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A whole item, as it lies in its folder.
struct WholeItem {
  std::string name;  // "000017"
  fs::path folder;
  std::string labels_text;
  Json labels;

  std::string place() const { return "items/" + name + "/"; }
  std::string bytes(const std::string& file) const { return read_file((folder / file).string()); }
};

WholeItem read_item(const fs::path& batch, int number) {
  WholeItem item{item_name(number), {}, {}, {}};
  item.folder = batch / "items" / item.name;
  item.labels_text = item.bytes(kItemLabels);
  item.labels = Json::parse(item.labels_text);
  return item;
}

std::string manifest_line(const WholeItem& item, int number) {
  const Json& labels = item.labels;
  const Json line = {{"item", number},
                     {"folder", item.place()},
                     {"chosen", labels["chosen"]},
                     {"leaf", labels["leaf"]["name"]},
                     {"species", labels["leaf"]["species"]},
                     {"metrics", labels["metrics"]},
                     {"files", labels["files"]}};
  return line.dump() + "\n";
}

std::string sums_of(const WholeItem& item) {
  std::string lines;
  for (const auto& [file, facts] : item.labels["files"].items())
    lines += fmt::format("{}  {}{}\n", facts["sha256"].get<std::string>(), item.place(), file);
  return lines;
}

void add_to_coco(CocoWriter& coco, const WholeItem& item) {
  for (const Json& picture : item.labels["pictures"]) {
    const std::string file = picture["file"];
    const std::string mask = fs::path(file).stem().string() + ".leaf.png";
    coco.add({item.place() + file, item.labels["leaf"]["species"], item.bytes(mask), picture.dump()});
  }
}

// "picture.leaf.png" of item 17 becomes 000017.leaf.png, item.json 000017.json.
void add_to_shards(WebDatasetWriter& shards, const WholeItem& item) {
  constexpr std::string_view kPicture = "picture.";
  std::vector<SampleFile> files;
  for (const auto& [name, facts] : item.labels["files"].items()) {
    const bool picture = name.rfind(kPicture, 0) == 0;
    files.push_back({picture ? name.substr(kPicture.size()) : name, item.bytes(name)});
  }
  files.push_back({"json", item.labels_text});
  shards.add(item.name, files);
}

}  // namespace

void write_manifest(const Plan& plan, const fs::path& folder, const std::vector<ItemState>& states,
                    const Monitor& monitor) {
  const Outputs& outputs = plan.outputs();
  FileWriter lines((folder / "manifest.jsonl").string()), sums((folder / "SHA256SUMS").string());
  std::optional<CocoWriter> coco;
  if (outputs.coco) coco.emplace((folder / "coco.json").string());
  std::optional<WebDatasetWriter> shards;
  if (outputs.webdataset) {
    const fs::path place = folder / "webdataset";
    fs::create_directories(place);
    shards.emplace(place.string(), ShardOptions{outputs.items_per_shard});
  }
  for (int number = 0; number < static_cast<int>(states.size()); ++number) {
    monitor.throw_if_cancelled();
    monitor.report("manifest", double(number) / double(states.size()));
    if (states[static_cast<std::size_t>(number)] == ItemState::failed) {
      const std::string file = (folder / "failed" / (item_name(number) + ".json")).string();
      lines.write(Json::parse(read_file(file)).dump() + "\n");
      continue;
    }
    const WholeItem item = read_item(folder, number);
    lines.write(manifest_line(item, number));
    sums.write(sums_of(item));
    if (coco) add_to_coco(*coco, item);
    if (shards) add_to_shards(*shards, item);
  }
  if (coco) coco->finish();
  if (shards) shards->finish();
  write_file((folder / "plan.toml").string(), plan.text());
  sums.finish();
  lines.finish();
}

}  // namespace wilt
