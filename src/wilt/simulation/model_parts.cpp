#include "wilt/simulation/model_parts.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

// The vein cell nearest to each vertex along edges (Dijkstra from all vein cells at once).
std::vector<int> nearest_vein_cell(const SurfaceMesh& mesh, const Points3& positions,
                                   const Eigen::VectorXd& vein_distance) {
  const double on_vein = 0.5 * mean_edge_length(mesh, positions);
  std::vector<int> nearest(mesh.num_vertices(), -1);
  std::vector<double> distance(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const VertexId v : mesh.vertices()) {
    if (vein_distance[v] > on_vein) continue;
    distance[v] = 0.0;
    nearest[v] = v;
    front.emplace(0.0, v);
  }
  while (!front.empty()) {
    const double reached = front.top().first;
    const VertexId v(front.top().second);
    front.pop();
    if (reached > distance[v]) continue;
    mesh.for_outgoing(v, [&](HalfedgeId h) {
      const VertexId w = mesh.to(h);
      const double candidate = reached + (positions.row(w) - positions.row(v)).norm();
      if (candidate >= distance[w]) return;
      distance[w] = candidate;
      nearest[w] = nearest[v];
      front.emplace(candidate, w);
    });
  }
  return nearest;
}

}  // namespace

Eigen::VectorXd rest_lengths(const SurfaceMesh& mesh, const Points3& rest) {
  const EdgeData<double> lengths = edge_lengths(mesh, rest);
  return Eigen::Map<const Eigen::VectorXd>(lengths.values().data(), lengths.size());
}

std::vector<char> pinned_vertices(const ModelInput& input) {
  std::vector<char> pinned(input.leaf.mesh.num_vertices(), 0);
  if (input.config.pin == "free") return pinned;
  pinned[input.leaf.petiole] = 1;
  for (const VertexId v : input.leaf.mesh.one_ring(input.leaf.petiole)) pinned[v] = 1;
  return pinned;
}

ExternalForce make_external_force(const ModelInput& input, double factor) {
  const Config& config = input.config;
  const Points3 first =
      initial_tip_forces(static_cast<int>(input.venation.tips.size()), config.external.variant);
  return {config.external.scale * factor * first, input.scale * input.venation.tip_distance,
          config.external.range, config.external.growth};
}

Eigen::VectorXd farthest_of_vein_cell(const Leaf& leaf, const Venation& venation) {
  const std::vector<int> nearest = nearest_vein_cell(leaf.mesh, leaf.positions, venation.primary_distance);
  const int n = leaf.mesh.num_vertices();
  Eigen::VectorXd farthest = Eigen::VectorXd::Zero(n);
  for (int v = 0; v < n; ++v)
    farthest[nearest[v]] = std::max(farthest[nearest[v]], venation.primary_distance[v]);
  Eigen::VectorXd result(n);
  for (int v = 0; v < n; ++v) result[v] = farthest[nearest[v]];
  return result;
}

std::vector<Points3> forces_of(const System& system, const std::vector<std::string>& names, const Points3& x,
                               const Points3& v) {
  std::vector<Points3> forces(names.size());
  parallel_for(static_cast<int>(names.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      forces[i] = system.force_of(names[i], x, v);
  });
  return forces;
}

}  // namespace wilt
