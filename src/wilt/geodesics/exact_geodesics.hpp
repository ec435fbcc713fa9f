// Exact shortest distances and paths on a polyhedral surface.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "wilt/core/monitor.hpp"
#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

namespace detail {
class Unfolding;
}

/// Exact geodesics by propagation of distance windows (Mitchell, Mount, Papadimitriou 1987; Chen and Han
/// 1990), with the pruning of Xin and Wang 2009, in the bucket order of Xu et al. 2015.
///
/// Paths may bend at the margin and at vertices with more than 2 pi of surface around them. Keeps references
/// to mesh and positions (#V x 3): both must outlive it. Its queries are const, may run in parallel, and hold
/// their own memory. Deterministic. The constructor throws Error{input} when positions do not fit the mesh
/// or a face has no area; queries do when a vertex does not exist.
class ExactGeodesics {
 public:
  ExactGeodesics(const SurfaceMesh& mesh, const Points3& positions);

  /// Distance from `source` to every vertex, #V; infinite in other components.
  Eigen::VectorXd distances(VertexId source) const;

  /// The shortest path from `source` to each target: a polyline through faces, straight when unfolded.
  /// A single point when the target is the source. Throws Error{input} when there is no path.
  ///
  /// `within` (#V flags; empty: everywhere) bounds the search: paths go through faces that have a vertex
  /// there, and a path is empty when there is none.
  std::vector<SurfacePath> paths(VertexId source, const std::vector<VertexId>& targets,
                                 std::span<const char> within = {}) const;

 private:
  const SurfaceMesh& mesh_;
  const Points3& positions_;
  std::shared_ptr<const detail::Unfolding> unfolding_;
};

}  // namespace wilt
