#include "petiole_places.hpp"

#include <string>

#include "leaf_source.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"

namespace wilt::web {
namespace {

// The two coordinates of a file, Y up, that remain when the axis nearest to the blade's normal is left out.
Points2 mesh_places(const Leaf& leaf) {
  const Points3 file = file_points(leaf.placement, leaf.positions);
  Points3 normal(1, 3);
  normal.row(0) = area_vector(leaf.mesh, leaf.positions).transpose();
  Eigen::Index left_out = 0;
  file_normals(leaf.placement, normal).row(0).cwiseAbs().maxCoeff(&left_out);
  Points2 places(file.rows(), 2);
  places << file.col(left_out == 0 ? 1 : 0), file.col(left_out == 2 ? 1 : 2);
  return places;
}

// Of a drawing, x and y of its placement; y runs down in SVG.
Points2 drawn_places(const Leaf& leaf, bool y_down) {
  const Placement& placement = leaf.placement;
  const Points3 file = ((placement.scale * leaf.positions * placement.rotation.transpose()).rowwise() +
                        placement.translation.transpose());
  Points2 places = file.leftCols<2>();
  if (y_down) places.col(1) *= -1.0;
  return places;
}

Points2 photo_places(const Leaf& leaf) {
  const PhotoArea& area = leaf.photo->area;
  Points2 places(leaf.positions.rows(), 2);
  for (std::size_t p = 0; p < leaf.skin.vertex.size(); ++p) {
    const Vec2 uv = leaf.skin.uv.row(static_cast<Eigen::Index>(p)).transpose();
    places.row(leaf.skin.vertex[p]) = (area.origin + uv.cwiseProduct(area.size)).transpose();
  }
  return places;
}

Points2 places_of(const val& source, const Leaf& leaf) {
  const std::string kind = source["kind"].as<std::string>();
  if (kind == "photo") return photo_places(leaf);
  if (kind == "mesh") return mesh_places(leaf);
  if (kind == "species") {
    const bool moved = !source["petiole"].isUndefined();
    return 1000.0 * (moved ? species_leaf(source) : leaf).positions.leftCols<2>();
  }
  return drawn_places(leaf, kind == "drawing");
}

}  // namespace

std::vector<double> petiole_places(const val& source, const Leaf& leaf, const MarginProfile& margin) {
  const Points2 places = places_of(source, leaf);
  std::vector<double> flat;
  for (const VertexId v : margin.vertices) {
    flat.push_back(places(int(v), 0));
    flat.push_back(places(int(v), 1));
  }
  return flat;
}

}  // namespace wilt::web
