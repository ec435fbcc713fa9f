#include "wilt/output/obj.hpp"

#include <fmt/format.h>

#include <iterator>

#include "wilt/core/check.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/file.hpp"
#include "wilt/output/tube.hpp"
#include "wilt/output/version.hpp"

namespace wilt {
namespace {

void append_rows(std::string& text, const char* keyword, const Points3& rows) {
  for (int i = 0; i < rows.rows(); ++i)
    fmt::format_to(std::back_inserter(text), "{} {:.9g} {:.9g} {:.9g}\n", keyword, rows(i, 0), rows(i, 1),
                   rows(i, 2));
}

void append_blade(std::string& text, const Leaf& leaf, const Points3& positions) {
  text += "o blade\n";
  append_rows(text, "v", file_points(leaf.placement, positions));
  for (int s = 0; s < leaf.skin.uv.rows(); ++s)
    fmt::format_to(std::back_inserter(text), "vt {:.9g} {:.9g}\n", leaf.skin.uv(s, 0),
                   1.0 - leaf.skin.uv(s, 1));
  append_rows(text, "vn", file_normals(leaf.placement, vertex_normals(leaf.mesh, positions)));
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
void append_stalk(std::string& text, const Leaf& leaf, const Points3& centreline, int sides) {
  const Tube stalk = tube(centreline, leaf.stalk.radii, sides, tube_reference(centreline));
  const int first = leaf.mesh.num_vertices() + 1;
  text += "o stalk\n";
  append_rows(text, "v", file_points(leaf.placement, stalk.positions));
  append_rows(text, "vn", file_normals(leaf.placement, stalk.normals));
  for (int f = 0; f < stalk.faces.rows(); ++f) {
    fmt::format_to(std::back_inserter(text), "f {0}//{0} {1}//{1} {2}//{2}\n", first + stalk.faces(f, 0),
                   first + stalk.faces(f, 1), first + stalk.faces(f, 2));
  }
}

}  // namespace

std::string obj_text(const Leaf& leaf, const Frame& frame, int stalk_sides) {
  WILT_CHECK(frame.positions.rows() == leaf.mesh.num_vertices(), frame.positions.rows(),
             leaf.mesh.num_vertices());
  std::string text = fmt::format("# wilt {}\n# units: {}, up: Y, iteration: {}\n", version(),
                                 unit_name(leaf.placement), frame.iteration);
  append_blade(text, leaf, frame.positions);
  if (frame.stalk.rows() >= 2) append_stalk(text, leaf, frame.stalk, stalk_sides);
  return text;
}

void write_obj(const std::string& path, const Leaf& leaf, const Frame& frame, int stalk_sides) {
  write_file(path, obj_text(leaf, frame, stalk_sides));
}

}  // namespace wilt
