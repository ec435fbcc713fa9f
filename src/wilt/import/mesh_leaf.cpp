#include "wilt/import/mesh_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/import/flatten.hpp"
#include "wilt/import/mesh_file.hpp"
#include "wilt/import/remesh.hpp"
#include "wilt/import/surface_repair.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::detail {
namespace {

// ReadOptions::petiole for a mesh: the margin vertex nearest in two of the file's coordinates.
VertexId given_petiole(const Sheet& sheet, const Vec2& wanted, std::vector<std::string>& notes) {
  const Vec3 normal = to_file_axes(area_vector(sheet.mesh, sheet.positions));
  int left_out = 0;
  normal.cwiseAbs().maxCoeff(&left_out);
  const int first = left_out == 0 ? 1 : 0, second = left_out == 2 ? 1 : 2;
  VertexId best;
  double least = 1e300;
  for (const VertexId v : margin_loop(sheet.mesh, sheet.positions)) {
    const Vec3 p = to_file_axes(sheet.positions.row(v).transpose());
    const double distance = (Vec2(p[first], p[second]) - wanted).norm();
    if (distance < least) {
      least = distance;
      best = v;
    }
  }
  const Vec3 p = to_file_axes(sheet.positions.row(best).transpose());
  notes.push_back(fmt::format(
      "petiole as given: the margin vertex at ({:.4g}, {:.4g}, {:.4g}), {:.3g} from {},{} = ({:.4g}, {:.4g})",
      p.x(), p.y(), p.z(), least, "xyz"[first], "xyz"[second], wanted.x(), wanted.y()));
  return best;
}

VertexId guessed_petiole(const Sheet& sheet, std::vector<std::string>& notes) {
  const std::vector<VertexId>& margin = margin_loop(sheet.mesh, sheet.positions);
  const Points2 flat = project_to_plane(sheet.mesh, sheet.positions);
  Points2 ring(static_cast<int>(margin.size()), 2);
  for (std::size_t i = 0; i < margin.size(); ++i) ring.row(static_cast<int>(i)) = flat.row(margin[i]);
  const PetioleGuess guess = find_petiole(ring);
  const VertexId v = margin[guess.index];
  const Vec3 p = to_file_axes(sheet.positions.row(v).transpose());
  notes.push_back(fmt::format("petiole found at ({:.4g}, {:.4g}, {:.4g}): {} (confidence {:.0f} %){}", p.x(),
                              p.y(), p.z(), guess.reason, 100 * guess.confidence,
                              guess.confidence < 0.5 ? "; if that is wrong give --petiole X,Y" : ""));
  return v;
}

}  // namespace

void note_implausible_length(Leaf& leaf, const std::string& unit_advice) {
  const double length = leaf_length(leaf);
  if (length < 0.002 || length > 2.0)
    leaf.notes.push_back(fmt::format("the leaf is {:.4g} m long, which no leaf is: {}", length, unit_advice));
}

Leaf read_mesh_leaf(const std::filesystem::path& file, const ReadOptions& options, const Monitor& monitor) {
  Leaf leaf;
  leaf.name = file.stem().string();
  leaf.species = "generic";
  leaf.seed = options.seed;
  monitor.report("reading the mesh", 0.0);
  Sheet sheet = repair_surface(read_mesh_file(file, leaf.notes), leaf.notes);
  monitor.throw_if_cancelled();
  VertexId petiole = options.petiole ? given_petiole(sheet, *options.petiole, leaf.notes)
                                     : guessed_petiole(sheet, leaf.notes);
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
