#include <fmt/format.h>

#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/mesh_leaf.hpp"
#include "wilt/import/surface_petiole.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/leaf/relief.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt::detail {
namespace {

constexpr double kAssumedExtent = 100.0;  // mm across, of a photographed leaf whose scale nobody gave
constexpr int kPhotoVertices = 5000;      // teeth of a grape leaf are some 2 % of its length

// Of a photo.
void settle_scale(const ReadOptions& options, DrawnLeaf& drawn) {
  if (options.mm_per_pixel) {
    drawn.mm_per_unit = *options.mm_per_pixel;
    return;
  }
  const Points2& margin = drawn.outline.margin;
  const double extent = (margin.colwise().maxCoeff() - margin.colwise().minCoeff()).maxCoeff();
  drawn.mm_per_unit = kAssumedExtent / extent;
  drawn.notes.push_back(
      fmt::format("the scale is unknown: the leaf is taken to be {:.0f} mm across; give "
                  "--mm-per-pixel",
                  kAssumedExtent));
}

// Where a point of the margin is: `index` is its place among the points, a new one if it lies between two.
int nearest_margin_point(Points2& margin, const Vec2& wanted) {
  int segment = 0;
  double least = 1e300, at = 0.0;
  const int n = static_cast<int>(margin.rows());
  for (int i = 0; i < n; ++i) {
    const Vec2 a = margin.row(i), along = Vec2(margin.row((i + 1) % n)) - a;
    if (along.squaredNorm() == 0) continue;
    const double t = std::clamp((wanted - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (a + t * along - wanted).norm();
    if (distance >= least) continue;
    least = distance;
    segment = i;
    at = t;
  }
  if (at <= 1e-3) return segment;
  if (at >= 1 - 1e-3) return (segment + 1) % n;
  const Vec2 fresh = (1 - at) * margin.row(segment) + at * margin.row((segment + 1) % n);
  Points2 longer(n + 1, 2);
  longer.topRows(segment + 1) = margin.topRows(segment + 1);
  longer.row(segment + 1) = fresh.transpose();
  longer.bottomRows(n - segment - 1) = margin.bottomRows(n - segment - 1);
  margin = longer;
  return segment + 1;
}

std::string shown(const DrawnLeaf& drawn, const Vec2& p) {
  return fmt::format("({:.4g}, {:.4g})", p.x(), drawn.y_down ? 0.0 - p.y() : p.y());
}

// The petiole on the blade's margin: given, or where the stalk was, or guessed.
Vec2 settle_petiole(DrawnLeaf& drawn, StalkCut& cut) {
  Points2& margin = cut.blade.margin;
  if (drawn.petiole) {
    const Vec2 at = margin.row(nearest_margin_point(margin, *drawn.petiole)).transpose();
    drawn.notes.push_back(
        drawn.petiole_reason.empty()
            ? fmt::format("petiole as given: the margin at {}", shown(drawn, at))
            : fmt::format("petiole found at {}: {}", shown(drawn, at), drawn.petiole_reason));
    const double size = (margin.colwise().maxCoeff() - margin.colwise().minCoeff()).norm();
    if (cut.found && (at - cut.petiole).norm() > 0.05 * size) {
      cut.found = false;
      drawn.notes.push_back("the drawn stalk meets the blade elsewhere and was left out");
    }
    return at;
  }
  if (cut.found) {
    drawn.notes.push_back(fmt::format("a stalk was cut off; the petiole is where it met the blade, at {}",
                                      shown(drawn, cut.petiole)));
    return cut.petiole;
  }
  const PetioleGuess guess = find_petiole(margin);
  const Vec2 at = margin.row(guess.index).transpose();
  drawn.notes.push_back(fmt::format("petiole found at {}: {} (confidence {:.0f} %){}", shown(drawn, at),
                                    guess.reason, 100 * guess.confidence,
                                    guess.confidence < 0.5 ? "; if that is wrong give --petiole X,Y" : ""));
  return at;
}

// A drawing is flat, and a flat sheet cannot buckle: it gets the gentle shape of a fresh leaf, its midrib
// running to the apex.
void add_relief(Leaf& leaf) {
  const double length = leaf_length(leaf);
  const Relief relief({Vec2(0.0, 1.0)}, leaf.seed);
  const double base = relief(Vec2::Zero());
  for (const VertexId v : leaf.mesh.vertices()) {
    const Vec2 p = leaf.positions.row(v).head<2>().transpose() / length;
    leaf.positions(int(v), 2) = length * (relief(p) - base);
  }
}

// Texture coordinates that match the photo to the pixel; its y runs down, the outline's up.
Points2 photo_uv(const Points2& outline_points, const PhotoArea& area) {
  Points2 pixels = outline_points;
  pixels.col(1) *= -1.0;
  return (pixels.rowwise() - area.origin.transpose()) * area.size.cwiseInverse().asDiagonal();
}

}  // namespace

Leaf leaf_from_outline(DrawnLeaf drawn, const std::string& name, const ReadOptions& options,
                       const Monitor& monitor) {
  if (drawn.photo) settle_scale(options, drawn);
  validate_outline(drawn.outline);
  if (options.petiole)
    drawn.petiole = Vec2(options.petiole->x(), drawn.y_down ? -options.petiole->y() : options.petiole->y());
  StalkCut cut = cut_stalk(drawn.outline);
  MeshingOptions meshing;
  meshing.vertices = options.vertices.value_or(drawn.photo ? kPhotoVertices : meshing.vertices);
  meshing.smallest_angle += kReliefReserve;
  if (drawn.photo) meshing.smoothing = 0.5;  // teeth are what makes it this leaf
  meshing.keep = {settle_petiole(drawn, cut)};
  PlanarMesh planar = mesh_outline(cut.blade, meshing, monitor);

  Leaf leaf;
  leaf.name = name;
  leaf.species = "generic";
  leaf.seed = options.seed;
  leaf.notes = std::move(drawn.notes);
  leaf.mesh = std::move(planar.mesh);
  Points3 file_positions = Points3::Zero(planar.positions.rows(), 3);
  file_positions.leftCols<2>() = planar.positions;
  validate_blade(leaf.mesh, file_positions);
  place_in_leaf_frame(leaf, file_positions, planar.kept.front(), drawn.mm_per_unit / 1000.0);
  add_relief(leaf);
  if (cut.found) {
    Points3 centreline = Points3::Zero(cut.centreline.rows(), 3);
    centreline.leftCols<2>() = cut.centreline;
    place_stalk(leaf, centreline, cut.half_widths);
  }
  leaf.skin = planar_skin(leaf.mesh, leaf.positions);
  leaf.photo = drawn.photo;
  if (leaf.photo) {
    leaf.skin.uv = photo_uv(planar.positions, leaf.photo->area);
    leaf.placement = {};  // pixels are nobody's units: files are in metres, the petiole at the origin
  }
  note_implausible_length(leaf, drawn.photo    ? "give --mm-per-pixel"
                                : drawn.y_down ? "give the drawing a width and height in mm and a viewBox"
                                               : "set mm_per_unit");
  return leaf;
}

}  // namespace wilt::detail
