// Fast, near-exact distances: a march that unfolds the source's image in each triangle.
#pragma once

#include <Eigen/Core>
#include <span>

#include "wilt/core/monitor.hpp"
#include "wilt/geodesics/surface_path.hpp"

namespace wilt {

/// Keeps references to mesh and positions (#V x 3): both must outlive it. Queries are const and may run in
/// parallel.
class FastGeodesics {
 public:
  FastGeodesics(const SurfaceMesh& mesh, const Points3& positions);

  Eigen::VectorXd distances(VertexId source) const;  ///< #V

  /// Distance from every vertex to the nearest of the polylines, #V (infinite when there is none).
  Eigen::VectorXd distances(std::span<const SurfacePath> sources) const;

 private:
  const SurfaceMesh& mesh_;
  const Points3& positions_;
};

enum class GeodesicMethod { fast, exact };

/// Distances from each of `sources` to every vertex, #sources x #V. In parallel; deterministic.
Eigen::MatrixXd geodesic_distances(const SurfaceMesh& mesh, const Points3& positions,
                                   std::span<const VertexId> sources, GeodesicMethod method,
                                   const Monitor& monitor = {});

/// The all-pairs matrix D, #V x #V, made symmetric by averaging. 8 #V^2 bytes.
Eigen::MatrixXd all_pairs(const SurfaceMesh& mesh, const Points3& positions, GeodesicMethod method,
                          const Monitor& monitor = {});

}  // namespace wilt
