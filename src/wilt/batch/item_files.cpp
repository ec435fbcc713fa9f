#include "wilt/batch/item_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "wilt/batch/sha256.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/output/veins_files.hpp"
#include "wilt/render/label_files.hpp"
#include "wilt/run/result_files.hpp"
#include "wilt/run/result_formats.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;
using Writer = std::string (*)(const WitheredLeaf&);

// The report without what differs from run to run.
Json timeless_report(const WitheredLeaf& withered) {
  Json report = Json::parse(report_of(withered));
  report.erase("timings_s");
  return report;
}

// The writer of a file that is no result, or none.
Writer writer_of(const std::string& name) {
  if (name == "report.json")
    return [](const WitheredLeaf& withered) { return timeless_report(withered).dump(2) + "\n"; };
  if (name == "forces.csv") return [](const WitheredLeaf& withered) { return forces_csv(withered.result); };
  if (name == "veins.json")
    return [](const WitheredLeaf& withered) { return veins_json(withered.leaf, withered.venation); };
  if (name == "veins.svg")
    return [](const WitheredLeaf& withered) { return veins_svg(withered.leaf, withered.venation); };
  return nullptr;
}

std::vector<LabelKind> kinds_of(const std::vector<std::string>& names) {
  std::vector<LabelKind> kinds;
  for (const LabelKind kind : all_label_kinds()) {
    if (std::find(names.begin(), names.end(), label_name(kind)) != names.end()) kinds.push_back(kind);
  }
  return kinds;
}

// The frames of the clip that are shown, from 0 to `last`.
std::vector<int> shown_frames(int wanted, int last) {
  if (wanted == 1) return {last};
  const int count = wanted == kEveryFrame ? last + 1 : std::min(wanted, last + 1);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(count == 1 ? last : static_cast<int>(std::lround(double(last) * i / (count - 1))));
  return frames;
}

// Writes the pictures with their label pictures; returns what is known of each.
Json write_pictures(const Item& item, const PicturePlan& plan, const WitheredLeaf& withered,
                    ResultFiles& files, const std::filesystem::path& folder, const Monitor& monitor) {
  Json pictures = Json::array();
  const LeafLabels labels(files.glb_file());
  const std::vector<int> frames = shown_frames(plan.frames, files.last_frame());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame& frame = withered.result.frames[static_cast<std::size_t>(frames[i])];
    const Scene scene = files.scene().at(frames[i], skin_water(withered.leaf, frame.water_fraction));
    PictureOptions options = item.picture;
    options.camera = frame_camera(scene_points(scene), double(plan.width) / plan.height, options.view);
    const std::string stem = picture_stem(static_cast<int>(i), static_cast<int>(frames.size()));
    write_image((folder / (stem + ".png")).string(), render(scene, options, monitor));
    const LabelMaps maps = labels.maps(scene, *options.camera, plan.width, plan.height, monitor);
    write_label_maps((folder / stem).string(), maps, kinds_of(plan.maps));
    Json picture = {{"file", stem + ".png"}, {"frame", frames[i]}, {"iteration", frame.iteration}};
    picture.update(Json::parse(label_json(maps)));
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

// Every file of the folder with its size and hash, by name.
Json listed(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  Json files = Json::object();
  for (const std::string& name : names) {
    const std::string bytes = read_file((folder / name).string());
    files[name] = {{"bytes", bytes.size()}, {"sha256", sha256(bytes)}};
  }
  return files;
}

}  // namespace

std::string item_name(int number) {
  return fmt::format("{:06}", number);
}

void check_item_files(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.empty() || name.find('/') != std::string::npos || name.front() == '.' || name == kItemLabels)
      throw Error(ErrorCode::configuration,
                  fmt::format("files takes names in the item's own folder, like leaf.glb, not '{}'", name));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw Error(ErrorCode::configuration, fmt::format("files has '{}' twice", name));
    if (writer_of(name) != nullptr) continue;
    try {
      result_format(name);
    } catch (const Error& error) {
      throw Error(error.code(),
                  fmt::format("{}; or report.json, forces.csv, veins.json, veins.svg", error.what()));
    }
  }
}

std::string picture_stem(int picture, int pictures) {
  if (pictures == 1) return "picture";
  const int digits = static_cast<int>(fmt::formatted_size("{}", pictures - 1));
  return fmt::format("picture.{:0{}}", picture, std::max(2, digits));
}

std::string chosen_json(const Item& item) {
  Json values = Json::object();
  for (const Assignment& chosen : item.chosen) {
    const Json value = Json::parse(chosen.value, nullptr, false);
    values[chosen.key] = value.is_number() || value.is_boolean() ? value : Json(chosen.value);
  }
  return values.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void make_item(const Item& item, const Outputs& outputs, const std::string& fingerprint,
               const std::filesystem::path& folder, PreparedLeaves& leaves, const Monitor& monitor) {
  WitheredLeaf withered = leaves.get(item.leaf, item.config, monitor);
  withered.result = simulate(withered.leaf, withered.venation, withered.config, monitor);
  if (withered.result.interrupted) throw Error(ErrorCode::interrupted, "interrupted");
  if (!withered.result.completed) throw Error(ErrorCode::simulation, withered.result.stop_reason);

  ResultFiles files(withered, monitor);
  for (const std::string& name : outputs.files) {
    monitor.throw_if_cancelled();
    const std::string path = (folder / name).string();
    if (const Writer writer = writer_of(name)) {
      write_file(path, writer(withered));
    } else {
      files.write(path);
    }
  }
  Json labels = {{"item", item.number}, {"fingerprint", fingerprint}};
  labels["chosen"] = Json::parse(chosen_json(item));
  labels.update(timeless_report(withered));
  labels.erase("steps");
  if (outputs.pictures.frames != 0)
    labels["pictures"] = write_pictures(item, outputs.pictures, withered, files, folder, monitor);
  labels["files"] = listed(folder);
  write_file((folder / kItemLabels).string(),
             labels.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace wilt
