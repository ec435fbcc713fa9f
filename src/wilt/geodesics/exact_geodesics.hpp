// Exact shortest distances and paths on a polyhedral surface.
#pragma once

#include <Eigen/Core>

#include "wilt/core/monitor.hpp"
#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

/// Exact geodesics by propagation of distance windows (Mitchell, Mount, Papadimitriou 1987, with the
/// pruning of Xin and Wang 2009 / vertex-oriented order of Qin et al. 2016).
///
/// Keeps references to mesh and positions (#V x 3): both must outlive it. Its queries are const and may run
/// in parallel.
class ExactGeodesics {
 public:
  ExactGeodesics(const SurfaceMesh& mesh, const Points3& positions);

  /// Distance from `source` to every vertex, #V.
  Eigen::VectorXd distances(VertexId source) const;

  /// The shortest path from `source` to each target: a polyline through faces, straight when unfolded.
  std::vector<SurfacePath> paths(VertexId source, const std::vector<VertexId>& targets) const;

 private:
  const SurfaceMesh& mesh_;
  const Points3& positions_;
};

}  // namespace wilt
