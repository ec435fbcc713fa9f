#include "wilt/geodesics/march_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wilt::detail {

MarchSurface::MarchSurface(const SurfaceMesh& surface_mesh, const Unfolding& unfolding)
    : mesh_(surface_mesh),
      edges_(surface_mesh.num_halfedges()),
      faces_(3 * static_cast<std::size_t>(surface_mesh.num_faces())),
      mean_length_(unfolding.mean_length()) {
  for (const VertexId v : mesh_.vertices()) {
    const double scale = mesh_.is_boundary(v) ? 1.0 : 2.0 * std::numbers::pi / unfolding.total_angle(v);
    mesh_.for_outgoing(v, [&](HalfedgeId h) {
      const double angle = -scale * unfolding.angle(h);
      edges_[h] = {unfolding.length(h), static_cast<float>(std::cos(angle)),
                   static_cast<float>(std::sin(angle))};
    });
  }
  for (int i = 0; i < 3 * mesh_.num_faces(); ++i) {
    const HalfedgeId h(i);
    const HalfedgeFrame& frame = unfolding.frame(h);
    const MarchEdge& away = edges_[mesh_.prev(h)];  // from the apex to a, which lies at -left
    faces_[h] = {frame.apex.x(), frame.apex.y(),
                 static_cast<float>(-(away.x * frame.left.x() + away.y * frame.left.y())),
                 static_cast<float>(away.x * frame.left.y() - away.y * frame.left.x())};
  }
}

}  // namespace wilt::detail
