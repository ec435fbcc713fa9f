#include "wilt/batch/item_fingerprint.hpp"

#include "wilt/batch/sha256.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/version.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

Json describe(const LeafRequest& request) {
  const ReadOptions& read = request.read;
  Json json = {{"leaf", request.leaf}, {"seed", read.seed},          {"nth", read.nth},
               {"scan", read.scan},    {"mask", read.mask.string()}, {"veins", request.veins}};
  const auto optional = [&json](const char* key, const auto& value) {
    if (value) json[key] = *value;
  };
  optional("vertices", read.vertices);
  optional("mm_per_pixel", read.mm_per_pixel);
  optional("threshold", read.threshold);
  optional("mm_per_unit", read.mm_per_unit);
  if (read.petiole) json["petiole"] = {read.petiole->x(), read.petiole->y()};
  return json;
}

Fingerprints::Fingerprints(const Outputs& outputs)
    : outputs_({{"files", outputs.files},
                {"frames", outputs.pictures.frames},
                {"size", {outputs.pictures.width, outputs.pictures.height}},
                {"samples", outputs.pictures.samples},
                {"maps", outputs.pictures.maps}}) {}

const std::string& Fingerprints::contents(const std::string& file) {
  const auto found = files_.find(file);
  if (found != files_.end()) return found->second;
  std::string hash;
  try {
    hash = sha256(read_file(file));
  } catch (const Error& error) {
    hash = "unreadable";  // the item will say why
  }
  return files_.emplace(file, std::move(hash)).first->second;
}

std::string Fingerprints::of(const Item& item) {
  Json leaf = describe(item.leaf);
  if (!is_species(item.leaf.leaf)) {
    leaf["leaf"] = contents(item.leaf.leaf);
    if (!item.leaf.read.mask.empty()) leaf["mask"] = contents(item.leaf.read.mask.string());
    if (!item.leaf.veins.empty()) leaf["veins"] = contents(item.leaf.veins);
  }
  Json json = {{"wilt", version()},
               {"item", item.number},
               {"leaf", leaf},
               {"config", to_json(item.config)},
               {"outputs", outputs_}};
  if (outputs_["frames"] != 0) {
    json["view"] = {item.picture.view.azimuth, item.picture.view.elevation};
    json["sun"] = numbers(item.picture.lighting.sun.direction);
    json["background"] = numbers(item.picture.background);
  }
  return sha256(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace wilt
