#include "wilt/output/obj.hpp"

#include <fmt/format.h>

#include <iterator>

#include "wilt/core/check.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/srgb.hpp"
#include "wilt/core/version.hpp"
#include "wilt/output/beside.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/moving.hpp"

namespace wilt {
namespace {

void append_rows(std::string& text, const char* keyword, const Points3& rows) {
  for (int i = 0; i < rows.rows(); ++i)
    fmt::format_to(std::back_inserter(text), "{} {:.9g} {:.9g} {:.9g}\n", keyword, rows(i, 0), rows(i, 1),
                   rows(i, 2));
}

void append_use(std::string& text, const std::string& material) {
  if (!material.empty()) text += fmt::format("usemtl {}\n", material);
}

void append_blade(std::string& text, const Leaf& leaf, const Shape& shape, const std::string& material) {
  text += "o blade\n";
  append_rows(text, "v", shape.positions);
  for (int s = 0; s < leaf.skin.uv.rows(); ++s)
    fmt::format_to(std::back_inserter(text), "vt {:.9g} {:.9g}\n", leaf.skin.uv(s, 0),
                   1.0 - leaf.skin.uv(s, 1));
  append_rows(text, "vn", shape.normals);
  append_use(text, material);
  for (int f = 0; f < leaf.skin.faces.rows(); ++f) {
    text += 'f';
    for (int c = 0; c < 3; ++c) {
      const int skin = leaf.skin.faces(f, c);
      const int vertex = leaf.skin.vertex[static_cast<std::size_t>(skin)];
      fmt::format_to(std::back_inserter(text), " {0}/{1}/{0}", vertex + 1, skin + 1);
    }
    text += '\n';
  }
}

// OBJ counts from 1 and on through the objects: the blade's vertices and normals come first.
void append_stalk(std::string& text, const Faces& faces, const Shape& shape, int blade_vertices,
                  const std::string& material) {
  const int first = blade_vertices + 1;
  text += "o stalk\n";
  append_rows(text, "v", shape.positions);
  append_rows(text, "vn", shape.normals);
  append_use(text, material);
  for (int f = 0; f < faces.rows(); ++f) {
    fmt::format_to(std::back_inserter(text), "f {0}//{0} {1}//{1} {2}//{2}\n", first + faces(f, 0),
                   first + faces(f, 1), first + faces(f, 2));
  }
}

void append_material(std::string& text, const std::string& name, const Vec3& linear,
                     const std::string& texture, const std::string& normal_map) {
  text += fmt::format("\nnewmtl {}\nillum 2\nKd", name);
  for (const double channel : linear) text += fmt::format(" {:.4f}", encode_srgb(channel));
  text += "\nKs 0.04 0.04 0.04\nNs 10\n";
  if (!texture.empty()) text += fmt::format("map_Kd {}\n", file_name(texture));
  if (!normal_map.empty()) text += fmt::format("norm {}\n", file_name(normal_map));
}

/// Writes the library of materials for frames, and what it refers to; each frame's materials end in `suffix`.
class Library {
 public:
  Library(const std::string& stem, const ShownColours& shown)
      : shown_(shown), path_(beside(stem, ".mtl")), normal_map_(write_normal_map(stem, shown.clip())) {}

  /// Adds the materials of a frame, whose OBJ is `path`.
  ObjMaterials add(const std::string& path, int frame, const std::string& suffix) {
    const Points3 colours = shown_.blade(frame);
    const std::string texture = write_texture(path, shown_, frame);
    const Vec3 colour = texture.empty() ? Vec3(colours.colwise().mean().transpose()) : Vec3(1.0, 1.0, 1.0);
    const ObjMaterials materials{file_name(path_), "blade" + suffix, "stalk" + suffix};
    append_material(text_, materials.blade, colour, texture, normal_map_);
    if (shown_.clip().frames.front().stalk.rows() >= 2)
      append_material(text_, materials.stalk, shown_.stalk(frame), "", "");
    return materials;
  }
  void write() const { write_file(path_, text_); }

 private:
  const ShownColours& shown_;
  std::string path_, normal_map_, text_ = fmt::format("# wilt {}\n", version());
};

}  // namespace

std::string obj_text(const Clip& clip, int frame, const ObjMaterials& materials, const ClipOptions& options) {
  options.validate();
  const Leaf& leaf = clip.leaf;
  const Frame& state = clip.frames[static_cast<std::size_t>(frame)];
  WILT_CHECK(state.positions.rows() == leaf.mesh.num_vertices(), state.positions.rows(),
             leaf.mesh.num_vertices());
  std::string text = fmt::format("# wilt {}\n# units: {}, up: Y, iteration: {}\n# config: {}\n", version(),
                                 unit_name(leaf.placement), state.iteration, clip.config);
  if (!materials.library.empty()) text += fmt::format("mtllib {}\n", materials.library);
  append_blade(text, leaf, blade_shape(clip, frame), materials.blade);
  if (state.stalk.rows() < 2) return text;
  const Moving stalk = moving_stalk(clip, options.stalk_sides);
  append_stalk(text, stalk.faces, stalk.shape(frame), leaf.mesh.num_vertices(), materials.stalk);
  return text;
}

void write_obj(const std::string& path, const ShownColours& shown, int frame, const ClipOptions& options) {
  options.validate();
  Library library(path, shown);
  const ObjMaterials materials = library.add(path, frame, "");
  library.write();
  write_file(path, obj_text(shown.clip(), frame, materials, options));
}

void write_obj_sequence(const std::string& pattern, const ShownColours& shown, const ClipOptions& options) {
  options.validate();
  check_sequence(pattern);
  Library library(sequence_stem(pattern), shown);
  std::vector<ObjMaterials> materials;
  for (int k = 0; k < static_cast<int>(shown.clip().frames.size()); ++k)
    materials.push_back(library.add(sequence_path(pattern, k), k, fmt::format(".{:04}", k)));
  library.write();
  for (int k = 0; k < static_cast<int>(materials.size()); ++k)
    write_file(sequence_path(pattern, k),
               obj_text(shown.clip(), k, materials[static_cast<std::size_t>(k)], options));
}

}  // namespace wilt
