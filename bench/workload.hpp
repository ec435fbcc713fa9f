// The one workload that wilt and its peers are compared on: a leaf-like surface and springs along its edges.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt::bench {

struct Surface {
  SurfaceMesh mesh;
  Points3 positions;  ///< #V x 3; the leaf's length is 1, its petiole at x = 0
};

/// A blade of about `vertices` vertices: a hexagonal lattice inside a leaf's outline, its points moved by up
/// to 12 % of the spacing along each axis, folded and rippled gently. Vertices run across the blade, row by
/// row. Deterministic.
Surface leaf_surface(int vertices);

/// The printed spring system on it, with rest lengths that shrink by up to 10 % in 100 steps.
struct SpringProblem {
  SurfaceMesh mesh;
  Points3 positions;                      ///< at the start, without velocity
  Edges edges;                            ///< #E x 2, sorted
  Eigen::VectorXd masses;                 ///< #V, 0.7 to 1.5
  std::vector<char> pinned;               ///< #V, the petiole's end
  Eigen::VectorXd first_rest, shrinkage;  ///< #E, rest length at the start; the share that it loses
  double stiffness;                       ///< 4 as in the paper, or 1000: about what a stiff cloth has
  double damping = 0.1;
  double gravity = 0.002;  ///< along -z
  double dt = 0.1;

  int vertex_count() const { return static_cast<int>(masses.size()); }
  int edge_count() const { return static_cast<int>(edges.rows()); }

  /// #E, in the step from `step` (0, 1, ...) to the next.
  Eigen::VectorXd rest_lengths(int step) const;
};

SpringProblem spring_problem(int vertices, double stiffness);

/// How many steps are timed: enough for a steady time, fewer on large leaves.
int timed_steps(int vertices);

/// Evenly spread vertices to measure distances from.
std::vector<VertexId> spread_sources(const SurfaceMesh& mesh, int count);

}  // namespace wilt::bench
