// What the laws along edges add to the matrix (internal).
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/block_matrix.hpp"
#include "wilt/mechanics/single_blocks.hpp"
#include "wilt/mechanics/spring_network.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt::detail {

struct StiffEdge {
  SinglePoint direction, stiffness;  ///< n; along, across_0, across_1
};

/// The symmetric part of minus the derivatives of a law's forces. With n the unit vector of an edge and l its
/// length, the block of its end k is
///
///     along n n^T + across_k (I - n n^T),   along = stretch,  across_k = stretch - push_k/l,
///
/// and off the diagonal minus the mean of both ends'; damping adds its coefficient times I.
class EdgeStiffness {
 public:
  /// `edges` #E x 2, coupled in `pattern`.
  EdgeStiffness(const Stencil& edges, const BlockPattern& pattern);

  /// matrix -= position_scale dF/dx + velocity_scale dF/dv at x; semi-definite: along and the mean of across
  /// clamped at 0, the mean at both ends. Eight edges at a time; every row gathers its own.
  void add(const EdgeLaw& law, const Points3& x, double position_scale, double velocity_scale,
           Curvature curvature, BlockMatrix& matrix);

 private:
  int edge_count_;
  std::vector<int> ends8_;       // per group of eight edges, 2 x 8 vertices
  std::vector<int> slot_edges_;  // per slot 2 edge + (0 or 1: the row is that end); -1 for none
  std::vector<StiffEdge> edges_;
};

}  // namespace wilt::detail
