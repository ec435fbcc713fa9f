#include "wilt/output/ply.hpp"

#include <fmt/format.h>

#include "wilt/core/file.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/core/version.hpp"
#include "wilt/output/byte_order.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {
namespace {

// In pieces: some readers (MeshLab's) take no line of more than 510 characters.
std::string config_comments(const std::string& config) {
  constexpr std::size_t kPiece = 400;
  std::string text;
  for (std::size_t at = 0; at < config.size(); at += kPiece)
    text += fmt::format("comment config: {}\n", config.substr(at, kPiece));
  return text;
}

std::string header(const Clip& clip, int frame, Eigen::Index vertices, Eigen::Index faces) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "comment wilt {}\ncomment units: {}, up: Y, iteration: {}\n{}element vertex {}\n",
      version(), unit_name(clip.leaf.placement), clip.frames[static_cast<std::size_t>(frame)].iteration,
      config_comments(clip.config), vertices);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t", "dryness"})
    text += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"}) text += fmt::format("property uchar {}\n", name);
  return text + fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", faces);
}

void append_floats(std::string& bytes, const Eigen::RowVectorXd& values) {
  for (const double value : values) append_little_endian(bytes, static_cast<float>(value));
}

void append_faces(std::string& bytes, const Faces& faces, int first) {
  for (int f = 0; f < faces.rows(); ++f) {
    append_little_endian(bytes, std::uint8_t{3});
    for (int c = 0; c < 3; ++c) append_little_endian(bytes, std::int32_t{first + faces(f, c)});
  }
}

/// Appends vertices with their normals, texture coordinates, dryness and colours.
class Vertices {
 public:
  explicit Vertices(std::string& bytes) : bytes_(bytes) {}

  void append(const Shape& shape, int row, const Vec2& st, double dryness, const Vec3& linear) {
    append_floats(bytes_, shape.positions.row(row));
    append_floats(bytes_, shape.normals.row(row));
    append_floats(bytes_, Eigen::RowVector3d(st.x(), st.y(), dryness));
    for (const double channel : linear) append_little_endian(bytes_, encode_(channel));
  }

 private:
  std::string& bytes_;
  SrgbBytes encode_;
};

}  // namespace

std::string ply_bytes(const ShownColours& shown, int frame, const ClipOptions& options) {
  options.validate();
  const Clip& clip = shown.clip();
  const Skin& skin = clip.leaf.skin;
  const Frame& state = clip.frames[static_cast<std::size_t>(frame)];
  const int size = static_cast<int>(skin.vertex.size());
  Moving stalk;
  Shape stalk_shape;
  if (state.stalk.rows() >= 2) {
    stalk = moving_stalk(clip, options.stalk_sides);
    stalk_shape = stalk.shape(frame);
  }
  std::string bytes =
      header(clip, frame, size + stalk_shape.positions.rows(), skin.faces.rows() + stalk.faces.rows());
  Vertices vertices(bytes);
  const Shape blade = blade_shape(clip, frame);
  const Points3 colours = shown.blade(frame);
  for (int s = 0; s < size; ++s) {
    const int v = skin.vertex[static_cast<std::size_t>(s)];
    const Vec2 st = skin.uv.rows() > 0 ? Vec2(skin.uv(s, 0), 1.0 - skin.uv(s, 1)) : Vec2(0.0, 0.0);
    vertices.append(blade, v, st, state.dryness.size() > 0 ? state.dryness[v] : 0.0, colours.row(v));
  }
  for (int i = 0; i < stalk_shape.positions.rows(); ++i)
    vertices.append(stalk_shape, i, Vec2::Zero(), 0.0, shown.stalk(frame));
  append_faces(bytes, skin.faces, 0);
  append_faces(bytes, stalk.faces, size);
  return bytes;
}

void write_ply(const std::string& path, const ShownColours& shown, int frame, const ClipOptions& options) {
  write_file(path, ply_bytes(shown, frame, options));
}

}  // namespace wilt
