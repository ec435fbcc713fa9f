// Fast, near-exact distances: a march that unfolds the source's image in each triangle.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "wilt/core/monitor.hpp"
#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

namespace detail {
class MarchSurface;
}

/// Distances from a front that carries the unfolded image of its source from face to face.
///
/// Keeps a reference to the mesh, which must outlive it; positions are #V x 3. Queries are const and may run
/// in parallel. Deterministic, O(#V log #V). The constructor throws Error{input} when positions do not fit
/// the mesh or a face has no area; queries do when a source does not lie on the mesh.
class FastGeodesics {
 public:
  FastGeodesics(const SurfaceMesh& mesh, const Points3& positions);

  Eigen::VectorXd distances(VertexId source) const;  ///< #V; infinite in other components

  /// The same from each source, #V x #sources, in parallel. Throws Error{interrupted} when the monitor asks
  /// to stop.
  Eigen::MatrixXd distances(std::span<const VertexId> sources, const Monitor& monitor = {}) const;

  /// Distance from every vertex to the nearest of the polylines, #V (infinite when there is none).
  Eigen::VectorXd distances(std::span<const SurfacePath> sources) const;

 private:
  const SurfaceMesh& mesh_;
  std::shared_ptr<const detail::MarchSurface> surface_;
};

enum class GeodesicMethod { fast, exact };

/// Distances from each of `sources` to every vertex, #V x #sources. In parallel; deterministic. Throws
/// Error{input} as the query classes do, Error{interrupted} when the monitor asks to stop.
Eigen::MatrixXd geodesic_distances(const SurfaceMesh& mesh, const Points3& positions,
                                   std::span<const VertexId> sources, GeodesicMethod method,
                                   const Monitor& monitor = {});

/// The all-pairs matrix D, #V x #V, made symmetric by averaging. 8 #V^2 bytes.
Eigen::MatrixXd all_pairs(const SurfaceMesh& mesh, const Points3& positions, GeodesicMethod method,
                          const Monitor& monitor = {});

}  // namespace wilt
