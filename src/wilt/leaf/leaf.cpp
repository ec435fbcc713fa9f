#include "wilt/leaf/leaf.hpp"

#include <algorithm>

namespace wilt {

double leaf_length(const Leaf& leaf) {
  const Eigen::RowVector3d origin = leaf.positions.row(leaf.petiole);
  return (leaf.positions.rowwise() - origin).rowwise().norm().maxCoeff();
}

Skin planar_skin(const SurfaceMesh& mesh, const Points3& positions) {
  constexpr double kMargin = 1.0 / 64.0;
  const Vec2 low = positions.leftCols<2>().colwise().minCoeff().transpose();
  const Vec2 high = positions.leftCols<2>().colwise().maxCoeff().transpose();
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0.0 ? (1.0 - 2.0 * kMargin) / extent : 0.0;
  const Vec2 centre = 0.5 * (low + high);
  Skin skin;
  skin.faces = mesh.face_matrix();
  skin.uv.resize(positions.rows(), 2);
  for (const VertexId v : mesh.vertices()) {
    skin.vertex.push_back(v);
    const Vec2 p = positions.row(v).head<2>().transpose();
    skin.uv.row(v) << 0.5 + scale * (p.x() - centre.x()), 0.5 - scale * (p.y() - centre.y());
  }
  return skin;
}

}  // namespace wilt
