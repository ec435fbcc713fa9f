// Seven labelled pictures of a small leaf in DIR, as a COCO file and as shards of three; beside each picture
// its labels as plain floats (KEY.bin: part, vein, water, depth, normals), for check_dataset.py.
#include <filesystem>
#include <string>

#include "output/sample_leaf.hpp"
#include "wilt/core/file.hpp"
#include "wilt/dataset/coco.hpp"
#include "wilt/dataset/webdataset.hpp"
#include "wilt/output/picture_file.hpp"
#include "wilt/render/label_files.hpp"
#include "wilt/render/leaf_scene.hpp"
#include "wilt/render/picture.hpp"

namespace {

using namespace wilt;

constexpr int kPictures = 7, kWidth = 64, kHeight = 49, kUnseen = 5;

template <class Values>
void append(std::string& bytes, const Values& values) {
  for (const auto& value : values) {
    const auto number = static_cast<float>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
}

std::string numbers_of(const LabelMaps& maps) {
  std::string bytes;
  append(bytes, maps.part);
  append(bytes, maps.vein);
  append(bytes, maps.water);
  append(bytes, maps.depth);
  append(bytes, Eigen::Map<const Eigen::VectorXf>(maps.normals.data(), maps.normals.size()));
  return bytes;
}

/// Picture i: five frames, nothing, and the last frame from another side.
void write_picture(const std::string& stem, const GlbFile& file, const Leaf& leaf,
                   const std::vector<Frame>& frames, int i) {
  const auto k = static_cast<std::size_t>(std::min(i, 4));
  const LeafScene shown(file);
  const Scene scene = shown.at(double(k), skin_water(leaf, frames[k].water_fraction));
  PictureOptions picture;
  picture.width = kWidth, picture.height = kHeight, picture.samples = 1;
  picture.view.elevation = i == 6 ? 0.1 : 0.8;
  picture.camera = frame_camera(scene_points(scene), double(kWidth) / kHeight, picture.view);
  if (i == kUnseen) picture.camera->forward *= -1.0;
  write_image(stem + ".png", render(scene, picture));
  const LabelMaps maps = LeafLabels(file, {0.003, 0.6}).maps(scene, *picture.camera, kWidth, kHeight);
  write_label_maps(stem, maps, all_label_kinds());
  write_file(stem + ".json", label_json(maps));
  write_file(stem + ".bin", numbers_of(maps));
}

void write_all(const std::string& folder) {
  const test::Sample sample;
  const GlbFile file = parse_glb(glb_bytes(sample.clip()), "sample");
  CocoWriter coco(folder + "/coco.json");
  WebDatasetWriter shards(folder, {3});
  for (int i = 0; i < kPictures; ++i) {
    const std::string key = "00001" + std::to_string(i), stem = folder + "/" + key;
    write_picture(stem, file, sample.leaf, sample.frames, i);
    coco.add({key + ".png", i == 3 ? "ivy <\"\xc3\xa9>" : "maple", read_file(stem + ".leaf.png"),
              read_file(stem + ".json")});
    std::vector<SampleFile> files;
    for (const char* suffix : {"png", "leaf.png", "depth.png", "json"})
      files.push_back({suffix, read_file(stem + "." + suffix)});
    shards.add(key, files);
  }
  coco.finish();
  shards.finish();
}

}  // namespace

int main(int, char** argv) {
  std::filesystem::remove_all(argv[1]);
  std::filesystem::create_directories(argv[1]);
  write_all(argv[1]);
  return 0;
}
