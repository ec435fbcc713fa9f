#include "wilt/simulation/model_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <queue>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/leaf/curves.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/simulate.hpp"

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

// Those of external.forces, or else of external.variant, #tips x 3.
Points3 first_tip_forces(const ModelInput& input) {
  const auto& external = input.config.external;
  const std::size_t tips = input.venation.tips.size();
  if (external.forces.empty()) return initial_tip_forces(static_cast<int>(tips), external.variant);
  if (external.forces.size() != 3 * tips)
    throw Error(
        ErrorCode::configuration,
        fmt::format("external.forces holds {} numbers, but the leaf has {} tips: give {}, x, y and z of "
                    "each, or none",
                    external.forces.size(), tips, 3 * tips));
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(external.forces.data(), static_cast<Eigen::Index>(tips), 3);
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

Eigen::VectorXd water_loss(const ModelInput& input, double rate) {
  const auto& water = input.config.water;
  const Eigen::VectorXd even = Eigen::VectorXd::Constant(input.rest.rows(), rate);
  if (water.dry_region.empty()) return even;
  detail::Polyline region;
  for (std::size_t k = 0; k < water.dry_region.size(); k += 2)
    region.emplace_back(water.dry_region[k], water.dry_region[k + 1]);
  Eigen::VectorXd loss = even;
  parallel_for(static_cast<int>(loss.size()), 1024, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      const Vec2 place = input.rest.row(v).head<2>().transpose() / kWorkingLength;
      if (detail::is_inside(region, place)) loss[v] *= water.dry_factor;
    }
  });
  return loss;
}

ExternalForce make_external_force(const ModelInput& input, double factor) {
  const Config& config = input.config;
  const Points3 first = first_tip_forces(input);
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
