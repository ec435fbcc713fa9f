#include "wilt/dataset/coco.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/core/version.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

[[noreturn]] void refuse(const CocoPicture& picture, const std::string& reason) {
  throw Error(ErrorCode::input, fmt::format("picture '{}' cannot be annotated: {}; make its item again",
                                            picture.file_name, reason));
}

Image mask_of(const CocoPicture& picture) {
  try {
    return decode_image(picture.mask);
  } catch (const Error&) {
    refuse(picture, "its mask cannot be read");
  }
}

// [x, y, v] for base and apex; three zeros where the leaf has none.
Json keypoints(const Json& labels) {
  Json points = Json::array();
  for (const char* name : {"base", "apex"}) {
    const Json& point = labels.at(name);
    for (std::size_t i = 0; i < 3; ++i) points.push_back(point.is_null() ? Json(0) : point.at(i));
  }
  return points;
}

Json annotation(const Image& mask, const Json& labels) {
  const Json points = keypoints(labels);
  const int known = int(points.at(2).get<int>() > 0) + int(points.at(5).get<int>() > 0);
  return {{"bbox", labels.at("box")},
          {"area", labels.at("area")},
          {"segmentation", {{"counts", run_lengths(mask)}, {"size", {mask.height, mask.width}}}},
          {"iscrowd", 0},
          {"keypoints", points},
          {"num_keypoints", known},
          {"tips", labels.at("tips")}};
}

}  // namespace

std::vector<std::uint32_t> run_lengths(const Image& mask) {
  std::vector<std::uint32_t> runs;
  bool leaf = false;
  std::uint32_t length = 0;
  for (int x = 0; x < mask.width; ++x) {
    for (int y = 0; y < mask.height; ++y) {
      if ((*mask.pixel(x, y) != 0) != leaf) {
        runs.push_back(length);
        length = 0;
        leaf = !leaf;
      }
      ++length;
    }
  }
  runs.push_back(length);
  return runs;
}

CocoWriter::CocoWriter(const std::string& path) : file_(path) {
  file_.write(fmt::format(
      R"({{"info":{{"description":"leaves withered by wilt","version":"{}"}},"annotations":[)", version()));
}

int CocoWriter::category_id(const std::string& name) {
  const auto found = std::find(categories_.begin(), categories_.end(), name);
  const auto id = 1 + static_cast<int>(found - categories_.begin());
  if (found == categories_.end()) categories_.push_back(name);
  return id;
}

void CocoWriter::add(const CocoPicture& picture) {
  try {
    const Json labels = Json::parse(picture.labels);
    const Image mask = mask_of(picture);
    if (labels.at("width") != mask.width || labels.at("height") != mask.height)
      refuse(picture, fmt::format("its mask has {} x {} pixels, its labels say {} x {}", mask.width,
                                  mask.height, labels.at("width").dump(), labels.at("height").dump()));
    const Json image = {{"id", pictures_ + 1},
                        {"width", mask.width},
                        {"height", mask.height},
                        {"file_name", picture.file_name}};
    if (labels.at("area").get<int>() > 0) {
      Json json = {{"id", annotations_ + 1},
                   {"image_id", pictures_ + 1},
                   {"category_id", category_id(picture.category)}};
      json.update(annotation(mask, labels));
      file_.write((annotations_++ > 0 ? ",\n" : "\n") + text(json));
    }
    images_ += (pictures_++ > 0 ? ",\n" : "\n") + text(image);
  } catch (const Json::exception& error) {
    refuse(picture, fmt::format("its labels are not what wilt writes ({})", error.what()));
  }
}

void CocoWriter::finish() {
  Json categories = Json::array();
  for (const std::string& name : categories_)
    categories.push_back({{"id", category_id(name)},
                          {"name", name},
                          {"supercategory", "leaf"},
                          {"keypoints", {"base", "apex"}},
                          {"skeleton", {{1, 2}}}});
  file_.write("\n],\"images\":[");
  file_.write(images_);
  file_.write(fmt::format("\n],\"categories\":{}}}\n", text(categories)));
  file_.finish();
}

}  // namespace wilt
