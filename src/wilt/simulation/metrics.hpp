// How wrinkled, curled and stretched a leaf is: one definition, used by every figure and test.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/simulation/wrinkle.hpp"

namespace wilt {

/// The metrics of docs/method.md, section 7, against a leaf at rest.
///
/// - wrinkle: see WrinkleMeter.
/// - curl: mean over the tips of the rotation (radians) of the mean normal of the vertices within 0.12 L of
///   the tip, relative to the best rigid rotation of the petiole's one-ring.
/// - strain: largest | l / l_rest - 1 | of any edge. Areas by sums of triangles; the
///   projected area is signed (what is folded over counts against).
class LeafMetrics {
 public:
  /// `rest` #V x 3 in any unit; the mesh must outlive this object.
  LeafMetrics(const SurfaceMesh& mesh, const Points3& rest, VertexId petiole,
              const std::vector<VertexId>& tips);

  /// `positions` #V x 3 in the unit of `rest`. Deterministic.
  FrameMetrics measure(const Points3& positions, int iteration) const;

  double wrinkle(const Points3& positions) const { return wrinkle_(positions); }
  double curl(const Points3& positions) const;  ///< radians
  double max_strain(const Points3& positions) const;

 private:
  struct Stencil {
    VertexId centre;
    std::vector<VertexId> around;
  };

  const SurfaceMesh& mesh_;
  Points3 rest_;
  double length_;  // L
  Vec3 rest_area_;
  double rest_surface_;
  EdgeData<double> rest_lengths_;
  Points3 rest_normals_;
  WrinkleMeter wrinkle_;
  std::vector<Stencil> tip_stencils_;
  std::vector<VertexId> petiole_ring_;
};

/// The rotation that turns the rest positions of `vertices` best (least squares, Kabsch 1976) onto the
/// current ones.
Eigen::Matrix3d best_rotation(const Points3& rest, const Points3& current,
                              const std::vector<VertexId>& vertices);

}  // namespace wilt
