#include "wilt/output/usd.hpp"

#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

#include "wilt/core/file.hpp"
#include "wilt/core/version.hpp"
#include "wilt/mesh/surface_mesh.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {
namespace {

/// Writes the statements of a layer, indented.
class Layer {
 public:
  std::string text;

  void line(std::string_view statement) {
    text.append(4 * static_cast<std::size_t>(depth_), ' ');
    text += statement;
    text += '\n';
  }
  void open(std::string_view prim) {
    line(prim);
    line("{");
    ++depth_;
  }
  // A dictionary of samples, which close() ends.
  void open_block(std::string_view statement) {
    line(std::string(statement) + " {");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}");
  }

 private:
  int depth_ = 0;
};

constexpr const char* kPerVertex = " (interpolation = \"vertex\")";

// Numbers that are not whole are float32, as readers hold them, in the fewest digits that give them back.
template <class Row>
std::string tuple(const Row& row) {
  std::string text = row.size() > 1 ? "(" : "";
  for (Eigen::Index c = 0; c < row.size(); ++c) {
    if (c > 0) text += ", ";
    using Number = std::conditional_t<std::is_integral_v<typename Row::Scalar>, int, float>;
    fmt::format_to(std::back_inserter(text), "{}", static_cast<Number>(row(c)));
  }
  if (row.size() > 1) text += ')';
  return text;
}

template <class Rows>
std::string list(const Rows& rows) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (i > 0) text += ", ";
    text += tuple(rows.row(i));
  }
  return text + ']';
}

std::string extent(const Points3& positions) {
  Points3 corners(2, 3);
  corners << positions.colwise().minCoeff(), positions.colwise().maxCoeff();
  return list(corners);
}

std::string quoted(const std::string& words) {
  std::string text = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return text + '"';
}

// A file beside the layer; names with an @ have a fence of their own.
std::string asset(const std::string& path) {
  const std::string name = file_name(path), fence = name.find('@') == std::string::npos ? "@" : "@@@";
  return fence + "./" + name + fence;
}

/// What a layer says of a clip: the statements in the order of the file.
class Writer {
 public:
  Writer(const ShownColours& shown, const ClipOptions& options, const UsdMaps& maps)
      : shown_(shown), clip_(shown.clip()), options_(options), maps_(maps), last_(shown.last_frame()) {
    for (const double time : key_times(clip_.frames, options.seconds))
      codes_.push_back(time * options.frame_rate);
  }

  std::string write() {
    header();
    layer_.open("def Xform \"leaf\" (kind = \"component\")");
    const bool has_stalk = clip_.frames.front().stalk.rows() >= 2;
    blade();
    if (has_stalk) stalk();
    layer_.open("def Scope \"materials\"");
    if (!maps_.texture.empty()) blade_material();
    if (has_stalk) stalk_material();
    layer_.close();
    layer_.close();
    return std::move(layer_.text);
  }

 private:
  using Value = std::function<std::string(int frame)>;

  void header() {
    layer_.text = fmt::format(
        "#usda 1.0\n(\n"
        "    customLayerData = {{\n"
        "        string \"wilt:version\" = {}\n"
        "        string \"wilt:leaf\" = {}\n"
        "        string \"wilt:config\" = {}\n"
        "    }}\n"
        "    defaultPrim = \"leaf\"\n"
        "    endTimeCode = {}\n"
        "    framesPerSecond = {}\n"
        "    metersPerUnit = {}\n"
        "    startTimeCode = 0\n"
        "    timeCodesPerSecond = {}\n"
        "    upAxis = \"Y\"\n)\n\n",
        quoted(version()), quoted(clip_.leaf.name), quoted(clip_.config), codes_.back(), options_.frame_rate,
        metres_per_unit(clip_.leaf.placement), options_.frame_rate);
  }

  // An attribute with a value per frame. Readers without time see its default, the last frame.
  void animated(const std::string& attribute, const Value& value, const std::string& metadata = "") {
    layer_.line(fmt::format("{} = {}{}", attribute, value(last_), metadata));
    if (last_ == 0) return;
    layer_.open_block(fmt::format("{}.timeSamples =", attribute));
    for (int k = 0; k <= last_; ++k)
      layer_.line(fmt::format("{}: {},", codes_[static_cast<std::size_t>(k)], value(k)));
    layer_.close();
  }

  // Leaves the mesh open.
  void mesh(const std::string& name, bool has_material, const Faces& faces,
            const std::function<Shape(int)>& shape_at) {
    layer_.open(fmt::format("def Mesh \"{}\"{}", name,
                            has_material ? " (prepend apiSchemas = [\"MaterialBindingAPI\"])" : ""));
    if (has_material) layer_.line(fmt::format("rel material:binding = </leaf/materials/{}>", name));
    layer_.line("uniform token subdivisionScheme = \"none\"");
    layer_.line("uniform bool doubleSided = 1");
    layer_.line("int[] faceVertexCounts = " + list(Eigen::VectorXi::Constant(faces.rows(), 3)));
    layer_.line("int[] faceVertexIndices = " + list(faces.reshaped<Eigen::RowMajor>()));
    std::vector<Shape> shapes;
    for (int k = 0; k <= last_; ++k) shapes.push_back(shape_at(k));
    const auto at = [&shapes](int k) -> const Shape& { return shapes[static_cast<std::size_t>(k)]; };
    animated("float3[] extent", [&at](int k) { return extent(at(k).positions); });
    animated("point3f[] points", [&at](int k) { return list(at(k).positions); });
    animated(
        "normal3f[] normals", [&at](int k) { return list(at(k).normals); }, kPerVertex);
  }

  void blade() {
    const Leaf& leaf = clip_.leaf;
    mesh("blade", !maps_.texture.empty(), leaf.mesh.face_matrix(),
         [this](int k) { return blade_shape(clip_, k); });
    animated(
        "color3f[] primvars:displayColor", [this](int k) { return list(shown_.blade(k)); }, kPerVertex);
    const auto per_vertex = [this](const char* name, Eigen::VectorXd Frame::*values) {
      if ((clip_.frames.front().*values).size() == 0) return;
      animated(
          fmt::format("float[] primvars:{}", name),
          [this, values](int k) { return list(clip_.frames[static_cast<std::size_t>(k)].*values); },
          kPerVertex);
    };
    per_vertex("dryness", &Frame::dryness);
    per_vertex("water", &Frame::water_fraction);
    if (leaf.skin.uv.rows() > 0) {
      Points2 st = leaf.skin.uv;
      st.col(1) = 1.0 - st.col(1).array();
      layer_.line("texCoord2f[] primvars:st = " + list(st) + " (interpolation = \"faceVarying\")");
      layer_.line("int[] primvars:st:indices = " + list(leaf.skin.faces.reshaped<Eigen::RowMajor>()));
    }
    layer_.close();
  }

  void stalk() {
    const Moving stalk = moving_stalk(clip_, options_.stalk_sides);
    mesh("stalk", true, stalk.faces, stalk.shape);
    animated(
        "color3f[] primvars:displayColor", [this](int k) { return list(shown_.stalk(k).transpose()); },
        " (interpolation = \"constant\")");
    layer_.close();
  }

  // A material whose surface shader is open.
  void open_material(const std::string& name) {
    path_ = "/leaf/materials/" + name;
    layer_.open(fmt::format("def Material \"{}\"", name));
    layer_.line(fmt::format("token outputs:surface.connect = <{}/surface.outputs:surface>", path_));
    open_shader("surface", "UsdPreviewSurface");
    layer_.line("float inputs:roughness = 0.7");
    layer_.line("float inputs:metallic = 0");
    layer_.line("token outputs:surface");
  }
  void open_shader(const char* name, const char* id) {
    layer_.open(fmt::format("def Shader \"{}\"", name));
    layer_.line(fmt::format("uniform token info:id = \"{}\"", id));
  }
  void connect(const char* input, const char* output) {
    layer_.line(fmt::format("{}.connect = <{}/{}>", input, path_, output));
  }

  void stalk_material() {
    open_material("stalk");
    animated("color3f inputs:diffuseColor", [this](int k) { return tuple(shown_.stalk(k)); });
    layer_.close();
    layer_.close();
  }

  void blade_material() {
    open_material("blade");
    connect("color3f inputs:diffuseColor", "colour.outputs:rgb");
    if (!maps_.normal_map.empty()) connect("normal3f inputs:normal", "relief.outputs:rgb");
    layer_.close();
    map("colour", maps_.texture, "sRGB");
    animated("float4 inputs:scale", [this](int k) { return scale(k); });
    layer_.close();
    if (!maps_.normal_map.empty()) {
      map("relief", maps_.normal_map, "raw");
      layer_.line("float4 inputs:scale = (2, 2, 2, 1)");
      layer_.line("float4 inputs:bias = (-1, -1, -1, 0)");
      layer_.close();
    }
    open_shader("st", "UsdPrimvarReader_float2");
    layer_.line("string inputs:varname = \"st\"");
    layer_.line("float2 outputs:result");
    layer_.close();
    layer_.close();
  }

  // Leaves the shader open.
  void map(const char* name, const std::string& file, const char* colour_space) {
    open_shader(name, "UsdUVTexture");
    layer_.line("asset inputs:file = " + asset(file));
    layer_.line(fmt::format("token inputs:sourceColorSpace = \"{}\"", colour_space));
    layer_.line("token inputs:wrapS = \"clamp\"");
    layer_.line("token inputs:wrapT = \"clamp\"");
    connect("float2 inputs:st", "st.outputs:result");
    layer_.line("float3 outputs:rgb");
  }

  // What the last frame's texture is multiplied by, so that its mean over the vertices is that of frame k.
  std::string scale(int k) const {
    const Vec3 here = shown_.blade(k).colwise().mean().transpose();
    const Vec3 last = shown_.blade(last_).colwise().mean().transpose();
    Eigen::Vector4d factor = Eigen::Vector4d::Ones();
    for (int c = 0; c < 3; ++c) factor[c] = last[c] > 0.0 ? here[c] / last[c] : 1.0;
    return tuple(factor);
  }

  const ShownColours& shown_;
  const Clip& clip_;
  const ClipOptions& options_;
  const UsdMaps& maps_;
  const int last_;
  std::vector<double> codes_;  // time codes of the frames
  Layer layer_;
  std::string path_;  // of the material that is being written
};

}  // namespace

std::string usd_text(const ShownColours& shown, const ClipOptions& options, const UsdMaps& maps) {
  options.validate();
  return Writer(shown, options, maps).write();
}

void write_usd(const std::string& path, const ShownColours& shown, const ClipOptions& options) {
  options.validate();
  const UsdMaps maps{write_texture(path, shown, shown.last_frame()), write_normal_map(path, shown.clip())};
  write_file(path, usd_text(shown, options, maps));
}

}  // namespace wilt
