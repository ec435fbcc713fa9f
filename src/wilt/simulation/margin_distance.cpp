#include "wilt/simulation/margin_distance.hpp"

#include <utility>
#include <vector>

#include "wilt/geodesics/fast_geodesics.hpp"

namespace wilt {

Eigen::VectorXd margin_distance(const Leaf& leaf) {
  const SurfaceMesh& mesh = leaf.mesh;
  std::vector<SurfacePath> rims;
  for (const std::vector<VertexId>& loop : mesh.boundary_loops()) {
    SurfacePath rim;
    for (const VertexId v : loop) rim.points.push_back(surface_point(mesh, v));
    rim.points.push_back(rim.points.front());
    rims.push_back(std::move(rim));
  }
  return FastGeodesics(mesh, leaf.positions).distances(rims);
}

}  // namespace wilt
