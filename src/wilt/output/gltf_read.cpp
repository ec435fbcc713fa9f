#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/printable.hpp"
#include "wilt/core/whole_number.hpp"
#include "wilt/output/glb_container.hpp"
#include "wilt/output/gltf.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;
using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kDeepest = 64;                  // levels of JSON
constexpr double kLongestClip = 24 * 3600.0;  // seconds

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorCode::input, reason + "; give a .glb that wilt wrote");
}

/// Checked access to the arrays of a model that may hold anything.
class Model {
 public:
  explicit Model(const tinygltf::Model& model) : model_(model) {}

  template <class Items>
  static const auto& at(const Items& items, int index, const char* what) {
    if (index < 0 || index >= static_cast<int>(items.size()))
      refuse(fmt::format("it refers to {} {} of {}", what, index, items.size()));
    return items[static_cast<std::size_t>(index)];
  }

  /// float32 rows of `columns` finite numbers.
  Values floats(int accessor, int columns) const {
    return rows_of(raw<float>(accessor, TINYGLTF_COMPONENT_TYPE_FLOAT, columns), columns, accessor);
  }

  /// #rows x 3 differences of a morph target; those that a sparse accessor leaves out are zero.
  Points3 differences(int index, Eigen::Index rows) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
    if (accessor.count != static_cast<std::size_t>(rows))
      refuse("a morph target differs in size from its mesh");
    if (accessor.bufferView >= 0) return floats(index, 3);
    check_kind(index, TINYGLTF_COMPONENT_TYPE_FLOAT, 3);
    Points3 result = Points3::Zero(rows, 3);
    if (!accessor.sparse.isSparse) return result;
    const auto count = static_cast<std::size_t>(std::max(accessor.sparse.count, 0));
    const auto& place = accessor.sparse.values;
    const Values values =
        rows_of(bytes<float>(place.bufferView, place.byteOffset, 3 * count, index), 3, index);
    const std::vector<std::uint32_t> moved = sparse_rows(index, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (moved[i] >= accessor.count) refuse(fmt::format("accessor {} has a row beyond its end", index));
      result.row(moved[i]) = values.row(static_cast<Eigen::Index>(i));
    }
    return result;
  }

  Faces triangles(int accessor, int vertices) const {
    const auto indices = raw<std::uint32_t>(accessor, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 1);
    Faces faces(static_cast<int>(indices.size() / 3), 3);
    for (int i = 0; i < faces.size(); ++i) {
      const std::uint32_t index = indices[static_cast<std::size_t>(i)];
      if (index >= static_cast<std::uint32_t>(vertices))
        refuse(fmt::format("a face has vertex {} of {}", index, vertices));
      faces(i / 3, i % 3) = static_cast<int>(index);
    }
    return faces;
  }

 private:
  static Values rows_of(const std::vector<float>& values, int columns, int accessor) {
    for (const float value : values)
      if (!std::isfinite(value)) refuse(fmt::format("accessor {} has a value that is not finite", accessor));
    return Eigen::Map<const Eigen::Matrix<float, -1, -1, Eigen::RowMajor>>(
               values.data(), static_cast<int>(values.size()) / columns, columns)
        .cast<double>();
  }

  void check_kind(int index, int component_type, int columns) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
    const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (accessor.componentType != component_type || width != columns)
      refuse(fmt::format("accessor {} is not of the kind that wilt writes", index));
  }

  // `count` values that stand close together in a view.
  template <class T>
  std::vector<T> bytes(int number, int offset, std::size_t count, int accessor) const {
    const tinygltf::BufferView& view = at(model_.bufferViews, number, "buffer view");
    const std::vector<unsigned char>& data = at(model_.buffers, view.buffer, "buffer").data;
    const auto skipped = static_cast<std::size_t>(std::max(offset, 0));
    if (view.byteStride != 0 || offset < 0 || view.byteOffset > data.size() ||
        skipped > data.size() - view.byteOffset ||
        count > (data.size() - view.byteOffset - skipped) / sizeof(T))
      refuse(fmt::format("accessor {} reaches beyond the file's data", accessor));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), data.data() + view.byteOffset + skipped, count * sizeof(T));
    return values;
  }

  // The values of a tightly packed accessor.
  template <class T>
  std::vector<T> raw(int index, int component_type, int columns) const {
    check_kind(index, component_type, columns);
    const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
    if (accessor.sparse.isSparse || accessor.byteOffset != 0)
      refuse(fmt::format("accessor {} is not of the kind that wilt writes", index));
    if (accessor.count > std::numeric_limits<std::uint32_t>::max())
      refuse(fmt::format("accessor {} reaches beyond the file's data", index));
    return bytes<T>(accessor.bufferView, 0, accessor.count * static_cast<std::size_t>(columns), index);
  }

  std::vector<std::uint32_t> sparse_rows(int index, std::size_t count) const {
    const auto& indices = model_.accessors[static_cast<std::size_t>(index)].sparse.indices;
    const auto widened = [&](auto narrow) {
      const auto read = bytes<decltype(narrow)>(indices.bufferView, indices.byteOffset, count, index);
      return std::vector<std::uint32_t>(read.begin(), read.end());
    };
    switch (indices.componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return widened(std::uint8_t{});
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return widened(std::uint16_t{});
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return widened(std::uint32_t{});
      default:
        refuse(fmt::format("accessor {} is not of the kind that wilt writes", index));
    }
  }

  const tinygltf::Model& model_;
};

int attribute(const std::map<std::string, int>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

// Base + target for every morph target; the base alone where none has the attribute. All have it or none.
std::vector<Points3> morphed(const Model& model, const tinygltf::Primitive& primitive,
                             const std::string& name) {
  const Points3 base = model.floats(attribute(primitive.attributes, name), 3);
  std::vector<Points3> frames;
  for (const auto& target : primitive.targets) {
    const int accessor = attribute(target, name);
    if (accessor < 0) continue;
    frames.push_back(base + model.differences(accessor, base.rows()));
  }
  if (!frames.empty() && frames.size() != primitive.targets.size())
    refuse(fmt::format("{} of {} morph targets have {}", frames.size(), primitive.targets.size(), name));
  if (frames.empty()) frames.push_back(base);
  return frames;
}

GlbMesh read_mesh(const Model& model, const tinygltf::Mesh& mesh) {
  if (mesh.primitives.size() != 1) refuse(fmt::format("mesh '{}' has several parts", mesh.name));
  const tinygltf::Primitive& primitive = mesh.primitives.front();
  GlbMesh result;
  result.name = mesh.name;
  result.frames = morphed(model, primitive, "POSITION");
  result.normals = morphed(model, primitive, "NORMAL");
  const int vertices = static_cast<int>(result.frames.front().rows());
  if (attribute(primitive.attributes, "COLOR_0") >= 0) result.colours = morphed(model, primitive, "COLOR_0");
  if (const int uv = attribute(primitive.attributes, "TEXCOORD_0"); uv >= 0) result.uv = model.floats(uv, 2);
  if (const int water = attribute(primitive.attributes, "_WATER"); water >= 0)
    result.water = model.floats(water, 1);
  result.faces = model.triangles(primitive.indices, vertices);
  if (vertices == 0 || result.faces.rows() == 0) refuse(fmt::format("mesh '{}' is empty", mesh.name));
  const auto fits = [vertices](Eigen::Index rows) { return rows == 0 || rows == vertices; };
  if (result.normals.front().rows() != vertices || !fits(result.uv.rows()) || !fits(result.water.size()) ||
      (!result.colours.empty() && result.colours.front().rows() != vertices) ||
      result.normals.size() != result.frames.size())
    refuse(fmt::format("the attributes of mesh '{}' differ in size", mesh.name));
  return result;
}

std::vector<double> read_times(const Model& model, const tinygltf::Model& gltf) {
  if (gltf.animations.empty()) return {0.0};
  const tinygltf::AnimationSampler& sampler = Model::at(gltf.animations.front().samplers, 0, "sampler");
  const Values values = model.floats(sampler.input, 1);
  const std::vector<double> times(values.data(), values.data() + values.size());
  for (std::size_t k = 0; k < times.size(); ++k)
    if (k == 0 ? times[k] != 0.0 : !(times[k] > times[k - 1] && times[k] <= kLongestClip))
      refuse(fmt::format("key time {} is {} s; times begin at 0, ascend and end within a day", k, times[k]));
  return times;
}

// The bytes of the image behind a texture, or nothing.
std::string read_texture(const tinygltf::Model& gltf, int texture) {
  if (texture < 0) return {};
  const int source = Model::at(gltf.textures, texture, "texture").source;
  const tinygltf::BufferView& view =
      Model::at(gltf.bufferViews, Model::at(gltf.images, source, "image").bufferView, "buffer view");
  const std::vector<unsigned char>& data = Model::at(gltf.buffers, view.buffer, "buffer").data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    refuse("the texture reaches beyond the file's data");
  return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
}

Points3 points_from(const Json& rows) {
  Points3 points(static_cast<int>(rows.size()), 3);
  for (int i = 0; i < points.rows(); ++i) {
    for (int c = 0; c < 3; ++c)
      points(i, c) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(c)).get<double>();
  }
  return points;
}

int count_from(const Json& value) {
  const std::optional<int> count = whole_number(value);
  if (!count)
    refuse(fmt::format("a number of its extras is no whole number from 0 to {}",
                       std::numeric_limits<int>::max()));
  return *count;
}

std::vector<int> counts_from(const Json& list) {
  std::vector<int> numbers;
  for (const Json& value : list) numbers.push_back(count_from(value));
  return numbers;
}

void read_extras(const Json& document, GlbFile& file) {
  const Json& extras = document["asset"]["extras"]["wilt"];
  file.generator = document["asset"].at("generator").get<std::string>();
  file.extras = extras.dump();
  file.iterations = counts_from(extras.at("frames"));
  file.dryness = extras.at("dryness").get<std::vector<double>>();
  const int faces = static_cast<int>(file.meshes.front().faces.rows());
  for (const double value : file.dryness)
    if (!(value >= 0.0 && value <= 1.0)) refuse(fmt::format("a dryness is {}, outside 0 to 1", value));
  for (const Json& vein : extras.at("veins")) {
    GlbVein read{count_from(vein.at("order")), points_from(vein.at("positions")),
                 counts_from(vein.at("faces")), points_from(vein.at("barycentric"))};
    const auto points = static_cast<std::size_t>(read.positions.rows());
    if (read.faces.size() != points || static_cast<std::size_t>(read.barycentric.rows()) != points)
      refuse("the lists of a vein differ in length");
    if (!(read.barycentric.array() >= -1e-6).all() || !(read.barycentric.array() <= 1.0 + 1e-6).all())
      refuse("a vein's barycentric coordinates lie outside 0 to 1");
    for (const int face : read.faces) {
      if (face < 0 || face >= faces) refuse(fmt::format("a vein lies in face {} of {}", face, faces));
    }
    file.veins.push_back(std::move(read));
  }
}

// Textures are kept as they are.
bool accept_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                  int, void*) {
  return true;
}

// A GLB that wilt wrote has everything inside; no other file is opened for it.
void refuse_other_files(const Json& document) {
  for (const char* kind : {"buffers", "images"})
    for (const Json& item : document.value(kind, Json::array()))
      if (item.is_object() && item.contains("uri")) refuse(fmt::format("its {} lie in other files", kind));
}

std::uint64_t size_from(const Json& value) {
  if (!value.is_number_unsigned()) refuse("a size or an index of its JSON is no whole number");
  return value.get<std::uint64_t>();
}

// tinygltf takes the address of an image's first byte before it knows whether there is one.
void check_images(const Json& document) {
  for (const Json& image : document.value("images", Json::array())) {
    const Json& view = document.at("bufferViews").at(size_from(image.at("bufferView")));
    const Json& buffer = document.at("buffers").at(size_from(view.at("buffer")));
    if (size_from(view.value("byteOffset", Json(0U))) >= size_from(buffer.at("byteLength")))
      refuse("an image lies beyond the file's data");
  }
}

tinygltf::Model load(std::string_view bytes) {
  if (bytes.size() > std::numeric_limits<unsigned int>::max()) refuse("it is larger than a GLB can be");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(accept_image, nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  if (!loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<unsigned int>(bytes.size())))
    refuse(errors.substr(0, errors.find('\n')));
  return model;
}

GlbFile read_all(std::string_view bytes, std::string_view json) {
  const Json document = Json::parse(json, [](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepest) refuse(fmt::format("its JSON is nested deeper than {}", kDeepest));
    return true;
  });
  refuse_other_files(document);
  check_images(document);
  if (!document.contains("/asset/extras/wilt"_json_pointer)) refuse("asset.extras.wilt is missing");
  const tinygltf::Model gltf = load(bytes);
  const Model model(gltf);
  GlbFile file;
  for (const tinygltf::Mesh& mesh : gltf.meshes) file.meshes.push_back(read_mesh(model, mesh));
  if (file.meshes.empty()) refuse("it has no mesh");
  if (!gltf.materials.empty()) {
    file.texture = read_texture(gltf, gltf.materials[0].pbrMetallicRoughness.baseColorTexture.index);
    file.normal_texture = read_texture(gltf, gltf.materials[0].normalTexture.index);
  }
  file.times = read_times(model, gltf);
  read_extras(document, file);
  for (const GlbMesh& mesh : file.meshes) {
    if (mesh.frames.size() != file.times.size() || mesh.frames.size() != file.iterations.size() ||
        file.dryness.size() != file.times.size()) {
      refuse(fmt::format("mesh '{}' has {} frames, {} key times and {} iterations", mesh.name,
                         mesh.frames.size(), file.times.size(), file.iterations.size()));
    }
  }
  return file;
}

}  // namespace

GlbFile parse_glb(std::string_view bytes, const std::string& name) {
  const std::string_view json = glb_json(bytes, name);
  try {
    return read_all(bytes, json);
  } catch (const Error& error) {
    throw Error(ErrorCode::input, fmt::format("'{}' is not a leaf that wilt wrote: {}", name, error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input,
                fmt::format("'{}' is not a leaf that wilt wrote: {}; give a .glb that wilt wrote", name,
                            untagged(error.what())));
  }
}

GlbFile read_glb(const std::string& path) {
  return parse_glb(read_file(path), path);
}

}  // namespace wilt
