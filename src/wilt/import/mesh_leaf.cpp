#include "wilt/import/mesh_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/import/flatten.hpp"
#include "wilt/import/remesh.hpp"
#include "wilt/import/surface_petiole.hpp"
#include "wilt/import/surface_repair.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::detail {
namespace {

VertexId nearest_on_margin(const std::vector<VertexId>& margin, const Points3& positions, const Vec3& place) {
  const auto distance = [&](VertexId v) { return (positions.row(v).transpose() - place).squaredNorm(); };
  return *std::min_element(margin.begin(), margin.end(),
                           [&](VertexId a, VertexId b) { return distance(a) < distance(b); });
}

// Known, given or guessed.
VertexId petiole_of(const TriangleSoup& soup, const Sheet& sheet, const ReadOptions& options,
                    std::vector<std::string>& notes) {
  const std::vector<VertexId>& margin = margin_loop(sheet.mesh, sheet.positions);
  if (soup.petiole) return nearest_on_margin(margin, sheet.positions, *soup.petiole);
  const Points2 flat = project_to_plane(sheet.mesh, sheet.positions);
  Points2 ring(static_cast<int>(margin.size()), 2);
  Points3 places(static_cast<int>(margin.size()), 3);
  for (std::size_t i = 0; i < margin.size(); ++i) {
    ring.row(static_cast<int>(i)) = flat.row(margin[i]);
    places.row(static_cast<int>(i)) = to_file_axes(sheet.positions.row(margin[i]).transpose()).transpose();
  }
  const Vec3 normal = to_file_axes(area_vector(sheet.mesh, sheet.positions));
  const int found = options.petiole ? given_petiole(places, normal, *options.petiole, notes)
                                    : guessed_petiole(ring, places, notes);
  return margin[found];
}

}  // namespace

void note_implausible_length(Leaf& leaf, const std::string& unit_advice) {
  const double length = leaf_length(leaf);
  if (length < 0.002 || length > 2.0)
    leaf.notes.push_back(fmt::format("the leaf is {:.4g} m long, which no leaf is: {}", length, unit_advice));
}

Leaf leaf_from_mesh(const TriangleSoup& soup, const std::string& name, const ReadOptions& options,
                    const Monitor& monitor) {
  Leaf leaf;
  leaf.name = name;
  leaf.notes = soup.notes;
  leaf.species = "generic";
  leaf.seed = options.seed;
  monitor.report("repairing the mesh", 0.0);
  Sheet sheet = repair_surface(soup, leaf.notes);
  monitor.throw_if_cancelled();
  VertexId petiole = petiole_of(soup, sheet, options, leaf.notes);
  if (options.vertices) {
    const int before = sheet.mesh.num_vertices();
    Remeshed fresh = remesh(sheet, petiole, *options.vertices, monitor);
    sheet = std::move(fresh.sheet);
    petiole = fresh.petiole;
    validate_blade(sheet.mesh, sheet.positions);
    leaf.notes.push_back(fmt::format("remeshed from {} to {} vertices", before, sheet.mesh.num_vertices()));
  }
  leaf.mesh = std::move(sheet.mesh);
  place_in_leaf_frame(leaf, sheet.positions, petiole, 1.0);
  if (sheet.skin.vertex.empty()) {
    leaf.notes.push_back("the mesh has no texture coordinates; the blade's own plane gives them");
    leaf.skin = planar_skin(leaf.mesh, leaf.positions);
  } else {
    leaf.skin = std::move(sheet.skin);
  }
  note_implausible_length(leaf, "mesh files are taken to be in metres; scale the file if they are not");
  return leaf;
}

}  // namespace wilt::detail
