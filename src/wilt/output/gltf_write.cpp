#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/output/file.hpp"
#include "wilt/output/glb_container.hpp"
#include "wilt/output/glb_extras.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/output/moving.hpp"
#include "wilt/output/version.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;
using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Fills the binary chunk and the accessors that describe it.
class Builder {
 public:
  tinygltf::Model model;
  std::string binary;

  int add_view(std::size_t size, int target) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = binary.size();
    view.byteLength = size;
    view.target = target;
    binary.resize(binary.size() + size);
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
  }
  int add_view(const void* data, std::size_t size, int target) {
    const int view = add_view(size, target);
    std::memcpy(at(view), data, size);
    return view;
  }

  /// Room for #N x (1, 2 or 3) values, which fill() writes.
  int add_floats(Eigen::Index rows, Eigen::Index columns, int target) {
    static constexpr std::array<int, 3> kTypes{TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3};
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(static_cast<std::size_t>(rows * columns) * sizeof(float), target);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = kTypes.at(static_cast<std::size_t>(columns) - 1);
    accessor.count = static_cast<std::size_t>(rows);
    return add_accessor(accessor);
  }

  /// Writes the values of an accessor; the format asks for bounds of positions and of key times. Of different
  /// accessors on several threads.
  void fill(int number, const Floats& values, bool bounds) {
    tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
    std::memcpy(at(accessor.bufferView), values.data(),
                static_cast<std::size_t>(values.size()) * sizeof(float));
    for (int c = 0; bounds && c < values.cols(); ++c) {
      accessor.minValues.push_back(values.col(c).minCoeff());
      accessor.maxValues.push_back(values.col(c).maxCoeff());
    }
  }

  int add_floats(const Floats& values, int target, bool bounds) {
    const int number = add_floats(values.rows(), values.cols(), target);
    fill(number, values, bounds);
    return number;
  }

  int add_indices(const Faces& faces) {
    const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor> indices =
        faces.cast<std::uint32_t>();
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(indices.data(), static_cast<std::size_t>(indices.size()) * 4,
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = static_cast<std::size_t>(indices.size());
    return add_accessor(accessor);
  }

 private:
  char* at(int view) { return binary.data() + model.bufferViews[static_cast<std::size_t>(view)].byteOffset; }
  int add_accessor(const tinygltf::Accessor& accessor) {
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
  }
};

// A viewer adds the difference to the float32 base, so it is taken from that: no error adds up, and the
// base's own frame differs by nothing.
Floats difference(const Points3& values, const Floats& base) {
  return values.cast<float>() - base;
}

void add_mesh(Builder& builder, const Moving& moving, const std::vector<Frame>& frames, int material) {
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  const Shape rest = moving.shape(0);
  const Floats positions = rest.positions.cast<float>(), normals = rest.normals.cast<float>();
  Floats colours;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  primitive.attributes["POSITION"] = builder.add_floats(positions, kTarget, true);
  primitive.attributes["NORMAL"] = builder.add_floats(normals, kTarget, false);
  if (moving.uv.rows() > 0)
    primitive.attributes["TEXCOORD_0"] = builder.add_floats(moving.uv.cast<float>(), kTarget, false);
  if (moving.colour_count > 0) {
    colours = moving.colours(moving.colour_count - 1).cast<float>();
    primitive.attributes["COLOR_0"] = builder.add_floats(colours, kTarget, false);
  }
  if (moving.water.size() > 0)
    primitive.attributes["_WATER"] = builder.add_floats(moving.water.cast<float>(), kTarget, false);
  primitive.indices = builder.add_indices(moving.faces);

  const int count = frames.size() > 1 ? static_cast<int>(frames.size()) : 0;
  const bool coloured = moving.colour_count > 1;
  std::vector<tinygltf::Value> names;
  for (int k = 0; k < count; ++k) {
    std::map<std::string, int> target;
    for (const char* name : {"POSITION", "NORMAL", "COLOR_0"}) {
      if (coloured || name != std::string_view("COLOR_0"))
        target[name] = builder.add_floats(positions.rows(), 3, kTarget);
    }
    primitive.targets.push_back(target);
    names.emplace_back(fmt::format("iteration {}", frames[static_cast<std::size_t>(k)].iteration));
  }
  parallel_for(count, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const Shape shape = moving.shape(k);
      const std::map<std::string, int>& target = primitive.targets[static_cast<std::size_t>(k)];
      builder.fill(target.at("POSITION"), difference(shape.positions, positions), true);
      builder.fill(target.at("NORMAL"), difference(shape.normals, normals), false);
      if (coloured) builder.fill(target.at("COLOR_0"), difference(moving.colours(k), colours), false);
    }
  });
  tinygltf::Mesh mesh;
  mesh.name = moving.name;
  mesh.primitives = {primitive};
  if (!names.empty()) {
    mesh.weights.assign(names.size(), 0.0);
    mesh.weights.back() = 1.0;
    // The names of the targets stand where Blender and three.js look for them.
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
void add_animation(Builder& builder, const std::vector<Frame>& frames, double seconds) {
  const int count = static_cast<int>(frames.size());
  if (count < 2) return;
  const double first = frames.front().iteration, last = frames.back().iteration;
  Floats times(count, 1), weights = Floats::Zero(count * count, 1);
  for (int k = 0; k < count; ++k) {
    times(k) = static_cast<float>(seconds * (frames[static_cast<std::size_t>(k)].iteration - first) /
                                  (last - first));
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

int add_material(Builder& builder, const std::string& name) {
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.7;
  builder.model.materials.push_back(material);
  return static_cast<int>(builder.model.materials.size()) - 1;
}

/// The number of the texture.
int add_texture(Builder& builder, const std::string& bytes, const char* name) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = bytes.substr(0, 2) == "\xff\xd8" ? "image/jpeg" : "image/png";
  image.bufferView = builder.add_view(bytes.data(), bytes.size(), 0);
  builder.model.images.push_back(image);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(builder.model.images.size()) - 1;
  builder.model.textures.push_back(texture);
  return static_cast<int>(builder.model.textures.size()) - 1;
}

void add_textures(Builder& builder, const Clip& clip, int material) {
  const int colour = add_texture(builder, clip.texture.empty() ? white_pixel() : clip.texture, "colour");
  tinygltf::Material& blade = builder.model.materials[static_cast<std::size_t>(material)];
  blade.pbrMetallicRoughness.baseColorTexture.index = colour;
  if (!clip.normal_texture.empty())
    blade.normalTexture.index = add_texture(builder, clip.normal_texture, "relief");
}

// tinygltf writes the model. The extras are put in here, since its values have no 64-bit integers (seeds) and
// no order of keys; so is the buffer, which it would copy.
std::string serialise(Builder& builder, const std::string& extras) {
  std::ostringstream text;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&builder.model, text, false, false);
  Json document = Json::parse(text.str());
  document["asset"]["extras"] = {{"wilt", Json::parse(extras)}};
  document["buffers"] = Json::array({{{"byteLength", builder.binary.size()}}});
  return join_glb(document.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(builder.binary));
}

// Of the file, or a little more, so that it need not move as it grows.
std::size_t expected_size(const Clip& clip) {
  const std::size_t corners = clip.leaf.skin.vertex.size(), frames = clip.frames.size();
  const std::size_t per_shape = 6 * sizeof(float), per_colour = 3 * sizeof(float);
  return corners * ((frames + 1) * per_shape + (clip.colours.size() + 1) * per_colour + 3 * sizeof(float)) +
         static_cast<std::size_t>(clip.leaf.skin.faces.size()) * sizeof(std::uint32_t) + clip.texture.size() +
         clip.normal_texture.size() + (frames + 4) * (std::size_t{1} << 16);
}

void check_scene(const Clip& clip) {
  const std::size_t frames = clip.frames.size();
  WILT_CHECK(frames >= 1, frames);
  WILT_CHECK(clip.colours.size() <= 1 || clip.colours.size() == frames, clip.colours.size(), frames);
  WILT_CHECK(clip.stalk_colours.size() <= 1 || clip.stalk_colours.size() == frames, clip.stalk_colours.size(),
             frames);
  const int vertices = clip.leaf.mesh.num_vertices();
  WILT_CHECK(Json::accept(clip.config), clip.config);
  for (const Points3& colours : clip.colours)
    WILT_CHECK(colours.rows() == vertices, colours.rows(), vertices);
  for (std::size_t k = 0; k < frames; ++k) {
    const Frame& frame = clip.frames[k];
    WILT_CHECK(frame.positions.rows() == vertices, k, frame.positions.rows(), vertices);
    WILT_CHECK(frame.positions.allFinite() && frame.stalk.allFinite(), k, frame.iteration);
    WILT_CHECK(frame.stalk.rows() == clip.frames[0].stalk.rows(), k, frame.stalk.rows());
    WILT_CHECK(k == 0 || frame.iteration > clip.frames[k - 1].iteration, k, frame.iteration);
  }
}

}  // namespace

void GlbOptions::validate() const {
  if (!(seconds > 0.0 && std::isfinite(seconds))) {
    throw Error(ErrorCode::configuration,
                fmt::format("seconds is {}: the length of the clip must be above 0", seconds));
  }
  if (stalk_sides < 3 || stalk_sides > 64) {
    throw Error(ErrorCode::configuration,
                fmt::format("stalk_sides is {}: a stalk has 3 to 64 sides", stalk_sides));
  }
}

std::vector<Frame> rest_frames(const Leaf& leaf) {
  Frame frame;
  frame.positions = leaf.positions;
  frame.stalk = leaf.stalk.centreline;
  frame.dryness = Eigen::VectorXd::Zero(leaf.positions.rows());
  return {frame};
}

std::string glb_bytes(const Clip& clip, const GlbOptions& options) {
  options.validate();
  check_scene(clip);
  Builder builder;
  const std::string extras = glb_extras(clip);
  builder.binary.reserve(expected_size(clip) + 2 * extras.size());
  builder.model.asset.generator = fmt::format("wilt {}", version());
  builder.model.asset.version = "2.0";
  builder.model.scenes.emplace_back();
  builder.model.defaultScene = 0;
  const int blade = add_material(builder, "blade");
  add_mesh(builder, moving_blade(clip), clip.frames, blade);
  add_textures(builder, clip, blade);
  if (clip.frames.front().stalk.rows() >= 2)
    add_mesh(builder, moving_stalk(clip, options.stalk_sides), clip.frames, add_material(builder, "stalk"));
  add_animation(builder, clip.frames, options.seconds);
  return serialise(builder, extras);
}

void write_glb(const std::string& path, const Clip& clip, const GlbOptions& options) {
  write_file(path, glb_bytes(clip, options));
}

}  // namespace wilt
