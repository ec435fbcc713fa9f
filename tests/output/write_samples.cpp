// Writes every format for readers that are not ours, and beside them what went into them, in the leaf frame.
// Usage: write_samples FOLDER
#include <filesystem>
#include <nlohmann/json.hpp>

#include "sample_leaf.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/image_codec.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/obj.hpp"
#include "wilt/output/ply.hpp"
#include "wilt/output/point_cache.hpp"
#include "wilt/output/usd.hpp"
#include "wilt/output/vtk.hpp"

namespace {

using Json = nlohmann::json;

template <class Matrix>
Json rows(const Matrix& matrix) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(i, c));
    list.push_back(row);
  }
  return list;
}

// All the others that hold the clip of NAME.glb.
void write_formats(const std::string& name, const wilt::Clip& clip, double seconds) {
  wilt::ClipOptions options;
  options.seconds = seconds;
  const wilt::ShownColours shown(clip);
  write_usd(name + ".usda", shown, options);
  write_point_caches(name + ".pc2", clip, options);
  write_point_caches(name + ".mdd", clip, options);
  write_pvd(name + ".pvd", shown, options);
  write_vtu(name + ".vtu", shown, shown.last_frame(), options);
  write_obj(name + ".obj", shown, shown.last_frame(), options);
  write_obj_sequence(name + "_all.####.obj", shown, options);
  for (int k = 0; k <= shown.last_frame(); ++k)
    write_ply(wilt::sequence_path(name + ".####.ply", k), shown, k, options);
}

// Texels of several greens.
wilt::Image checkered() {
  wilt::Image image{16, 16, {}};
  for (int i = 0; i < 256; ++i) {
    for (const int channel : {90 + i % 16, 140 + i / 16, 40})
      image.rgb.push_back(static_cast<std::uint8_t>(channel));
  }
  return image;
}

void write(const std::string& name, const wilt::Clip& clip, double seconds, int max_morphs = 0) {
  wilt::GlbOptions options;
  options.seconds = seconds;
  options.max_morphs = max_morphs;
  write_glb(name + ".glb", clip, options);
  write_formats(name, clip, seconds);
  const wilt::Leaf& leaf = clip.leaf;
  Json frames = Json::array();
  for (std::size_t k = 0; k < clip.frames.size(); ++k) {
    const wilt::Frame& frame = clip.frames[k];
    frames.push_back({{"iteration", frame.iteration},
                      {"positions", rows(frame.positions)},
                      {"stalk", rows(frame.stalk)},
                      {"dryness", rows(frame.dryness)},
                      {"water", rows(frame.water_fraction)}});
    if (!clip.colours.empty()) frames.back()["colours"] = rows(clip.colours.at(k));
    if (!clip.stalk_colours.empty())
      frames.back()["stalk_colour"] = rows(clip.stalk_colours.at(k).transpose());
  }
  const Json vertices(std::vector<int>(leaf.skin.vertex.begin(), leaf.skin.vertex.end()));
  const Json dump = {
      {"seconds", seconds},
      {"stalk_sides", options.stalk_sides},
      {"frames", frames},
      {"mesh_faces", rows(leaf.mesh.face_matrix())},
      {"skin", {{"vertex", vertices}, {"uv", rows(leaf.skin.uv)}, {"faces", rows(leaf.skin.faces)}}},
      {"radii", leaf.stalk.radii},
      {"rotation", rows(leaf.placement.rotation)},
      {"translation", rows(leaf.placement.translation.transpose())},
      {"scale", leaf.placement.scale}};
  wilt::write_file(name + ".json", dump.dump());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder);
  wilt::test::Sample sample;
  write(folder + "/withering", sample.clip(), 4.0);
  write(folder + "/fewer", sample.clip(), 4.0, 3);
  wilt::test::Sample calm;
  wilt::test::hold_most(calm);
  write(folder + "/calm", calm.clip(), 4.0);
  wilt::Clip textured = sample.clip();
  textured.texture = encode_jpeg(checkered());
  textured.normal_texture = encode_png(checkered());
  write(folder + "/textured", textured, 4.0);
  sample.leaf.placement = wilt::test::sample_placement();
  write(folder + "/placed", sample.clip(), 2.5);
  const std::vector<wilt::Frame> rest = rest_frames(sample.leaf);
  write(folder + "/rest", {sample.leaf, rest, nullptr, "{}", {}, {}, ""}, 4.0);
  sample.leaf.stalk = {};
  const std::vector<wilt::Frame> bare = rest_frames(sample.leaf);
  write(folder + "/bare", {sample.leaf, bare, nullptr, "{}", {}, {}, ""}, 4.0);
  return 0;
}
