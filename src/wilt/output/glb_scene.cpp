#include "wilt/output/glb_scene.hpp"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "wilt/core/image_codec.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/version.hpp"
#include "wilt/output/glb_builder.hpp"
#include "wilt/output/glb_container.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;
using Targets = std::vector<std::map<std::string, int>>;

// A viewer adds the difference to the float32 base, so it is taken from that: no error adds up, and the
// base's own frame differs by nothing.
Floats difference(const Points3& values, const Floats& base) {
  return values.cast<float>() - base;
}

// A target per frame: POSITION, NORMAL and, given colours per frame, COLOR_0, as differences from the base.
Targets add_targets(GlbBuilder& builder, const GlbScene& scene, const Moving& moving, const Floats& positions,
                    const Floats& normals, const Floats& colours) {
  const int count = static_cast<int>(scene.frames.kept.size());
  const bool coloured = moving.colour_count > 1;
  Targets targets(scene.frames.kept.size());
  for (std::map<std::string, int>& target : targets) {
    for (const char* name : {"POSITION", "NORMAL", "COLOR_0"}) {
      if (coloured || name != std::string_view("COLOR_0"))
        target[name] = builder.add_floats(positions.rows(), 3, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
  }
  parallel_for(count, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const int frame = scene.frames.kept[static_cast<std::size_t>(k)];
      const Shape shape = moving.shape(frame);
      const std::map<std::string, int>& target = targets[static_cast<std::size_t>(k)];
      builder.fill_difference(target.at("POSITION"), difference(shape.positions, positions), true);
      builder.fill_difference(target.at("NORMAL"), difference(shape.normals, normals), false);
      if (coloured)
        builder.fill_difference(target.at("COLOR_0"), difference(moving.colours(frame), colours), false);
    }
  });
  return targets;
}

tinygltf::Primitive add_primitive(GlbBuilder& builder, const GlbScene& scene, const Moving& moving) {
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  const Shape rest = moving.shape(0);
  const Floats positions = rest.positions.cast<float>(), normals = rest.normals.cast<float>();
  Floats colours;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = builder.add_floats(positions, kTarget, true);
  primitive.attributes["NORMAL"] = builder.add_floats(normals, kTarget, false);
  if (moving.uv.rows() > 0)
    primitive.attributes["TEXCOORD_0"] = builder.add_floats(moving.uv.cast<float>(), kTarget, false);
  if (moving.lookup.rows() > 0)
    primitive.attributes["TEXCOORD_1"] = builder.add_floats(moving.lookup.cast<float>(), kTarget, false);
  if (moving.colour_count > 0) {
    colours = moving.colours(moving.colour_count - 1).cast<float>();
    primitive.attributes["COLOR_0"] = builder.add_floats(colours, kTarget, false);
  }
  if (moving.water.size() > 0)
    primitive.attributes["_WATER"] = builder.add_floats(moving.water.cast<float>(), kTarget, false);
  primitive.indices = builder.add_indices(moving.faces);
  if (scene.frames.kept.size() > 1)
    primitive.targets = add_targets(builder, scene, moving, positions, normals, colours);
  return primitive;
}

void add_mesh(GlbBuilder& builder, const GlbScene& scene, const Moving& moving, int material) {
  tinygltf::Mesh mesh;
  mesh.name = moving.name;
  mesh.primitives = {add_primitive(builder, scene, moving)};
  mesh.primitives.front().material = material;
  if (scene.frames.kept.size() > 1) {
    mesh.weights.assign(scene.frames.kept.size(), 0.0);
    mesh.weights.back() = 1.0;
    // The names of the targets stand where Blender and three.js look for them.
    std::vector<tinygltf::Value> names;
    for (const int iteration : scene.iterations) names.emplace_back(fmt::format("iteration {}", iteration));
    mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
  }
  builder.model.meshes.push_back(mesh);

  tinygltf::Node node;
  node.name = moving.name;
  node.mesh = static_cast<int>(builder.model.meshes.size()) - 1;
  builder.model.nodes.push_back(node);
  builder.model.scenes.front().nodes.push_back(node.mesh);
}

// Key frame k shows frame k: the weight of target k is one there, all others are zero.
void add_animation(GlbBuilder& builder, const std::vector<double>& key_times) {
  const int count = static_cast<int>(key_times.size());
  if (count < 2) return;
  Floats times(count, 1), weights = Floats::Zero(count * count, 1);
  for (int k = 0; k < count; ++k) {
    times(k) = static_cast<float>(key_times[static_cast<std::size_t>(k)]);
    weights(k * count + k) = 1.0F;
  }
  tinygltf::AnimationSampler sampler;
  sampler.input = builder.add_floats(times, 0, true);
  sampler.output = builder.add_floats(weights, 0, false);
  sampler.interpolation = "LINEAR";
  tinygltf::Animation animation;
  animation.name = "withering";
  animation.samplers = {sampler};
  for (int node = 0; node < static_cast<int>(builder.model.nodes.size()); ++node) {
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = node;
    channel.target_path = "weights";
    animation.channels.push_back(channel);
  }
  builder.model.animations = {animation};
}

// A PNG of one white pixel: makes the texture coordinates count, and holds the place for a texture.
std::string white_pixel() {
  static constexpr std::array<unsigned char, 69> kPng{
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xda, 0x63, 0xf8, 0xff, 0xff, 0x3f, 0x00, 0x05, 0xfe, 0x02, 0xfe, 0x33, 0x12, 0x95,
      0x14, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return std::string(kPng.begin(), kPng.end());
}

int add_material(GlbBuilder& builder, const std::string& name) {
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.7;
  builder.model.materials.push_back(material);
  return static_cast<int>(builder.model.materials.size()) - 1;
}

/// The number of the texture.
int add_texture(GlbBuilder& builder, const std::string& bytes, const char* name) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = is_jpeg(bytes) ? "image/jpeg" : "image/png";
  image.bufferView = builder.add_view(bytes.data(), bytes.size(), 0);
  builder.model.images.push_back(image);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(builder.model.images.size()) - 1;
  builder.model.textures.push_back(texture);
  return static_cast<int>(builder.model.textures.size()) - 1;
}

void add_textures(GlbBuilder& builder, const GlbScene& scene, int material) {
  const int colour = add_texture(builder, scene.texture.empty() ? white_pixel() : scene.texture, "colour");
  tinygltf::Material& shown = builder.model.materials[static_cast<std::size_t>(material)];
  shown.pbrMetallicRoughness.baseColorTexture.index = colour;
  if (!scene.normal_texture.empty())
    shown.normalTexture.index = add_texture(builder, scene.normal_texture, "relief");
}

// tinygltf writes the model. The extras are put in here, since its values have no 64-bit integers (seeds) and
// no order of keys; so is the buffer, which it would copy.
std::string serialise(GlbBuilder& builder, const std::string& extras) {
  builder.pack();
  std::ostringstream text;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&builder.model, text, false, false);
  Json document = Json::parse(text.str());
  document["asset"]["extras"] = {{"wilt", Json::parse(extras)}};
  document["buffers"] = Json::array({{{"byteLength", builder.binary.size()}}});
  return join_glb(document.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(builder.binary));
}

// Of the file, or a little more, so that it need not move as it grows.
std::size_t expected_size(const GlbScene& scene) {
  std::size_t size = scene.texture.size() + scene.normal_texture.size() + 2 * scene.extras.size();
  for (const Moving& mesh : scene.meshes) {
    const auto corners = static_cast<std::size_t>(mesh.uv.rows());
    const auto colours = static_cast<std::size_t>(mesh.colour_count > 1 ? scene.frames.kept.size() + 1 : 1);
    const std::size_t rows = 2 * (scene.frames.kept.size() + 1) + colours + 3;
    size += corners * rows * 3 * sizeof(float) +
            static_cast<std::size_t>(mesh.faces.size()) * sizeof(std::uint32_t);
  }
  return size + (scene.frames.kept.size() + 4) * (std::size_t{1} << 16);
}

}  // namespace

std::string glb_bytes(const GlbScene& scene) {
  tinygltf::Model model;
  GlbBuilder builder(model);
  builder.binary.reserve(expected_size(scene));
  builder.model.asset.generator = fmt::format("wilt {}", version());
  builder.model.asset.version = "2.0";
  builder.model.scenes.emplace_back();
  builder.model.defaultScene = 0;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const int material = add_material(builder, scene.meshes[i].name);
    add_mesh(builder, scene, scene.meshes[i], material);
    if (i == 0) add_textures(builder, scene, material);
  }
  add_animation(builder, scene.times);
  return serialise(builder, scene.extras);
}

}  // namespace wilt
