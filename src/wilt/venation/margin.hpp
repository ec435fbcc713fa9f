// The boundary expansion of the paper (section 3): the margin as a curve d(s), and the peaks on it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// The margin walked clockwise from the petiole, in the flattened leaf.
struct MarginProfile {
  std::vector<VertexId> vertices;  ///< #M, the first is the margin vertex at (or nearest to) the petiole
  Eigen::VectorXd s;               ///< #M, accumulated length from the petiole
  Eigen::VectorXd d;               ///< #M, distance to the petiole
  double perimeter = 0.0;          ///< the length of the whole loop
};

/// `margin` in the order of SurfaceMesh::boundary_loops (clockwise), `flat` #V x 2, `petiole` on the margin
/// or next to it. O(#M).
MarginProfile expand_margin(const std::vector<VertexId>& margin, const Points2& flat, VertexId petiole);

enum class PeakRule { prominence, window };

struct PeakOptions {
  PeakRule rule = PeakRule::prominence;
  int window_vertices =
      8;  ///< window: strictly rising and falling over this half window, margin vertices, >= 1
  double window_length = 0.06;   ///< prominence: maximum over this share of the perimeter, 0 to 0.5
  double min_prominence = 0.02;  ///< prominence: at least this share of max(d), 0 to 1
  void validate() const;         ///< throws Error{configuration}
};

struct Peak {
  int index = 0;            ///< into the profile
  double prominence = 0.0;  ///< topographic, on the circular signal, in the unit of d
};

/// The peaks of d(s) in the order of s, without the petiole. Of equal heights within a window the first
/// counts. O(#M) times the vertices in a window, and O(#M) per peak.
std::vector<Peak> find_peaks(const MarginProfile& profile, const PeakOptions& options = {});

}  // namespace wilt
