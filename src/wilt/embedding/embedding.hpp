// Multidimensional scaling: points in the plane whose distances match a given matrix.
#pragma once

#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"

namespace wilt {

struct Embedding {
  Points2 coordinates;          ///< #V x 2
  double stress = 0.0;          ///< sum_{i<j} (|x_i - x_j| - D_ij)^2 / sum_{i<j} D_ij^2
  std::vector<double> history;  ///< the stress after each iteration (SMACOF)
};

/// Classical scaling (Torgerson 1952): double centring, the two leading eigenvectors. D is #V x #V,
/// symmetric, >= 0. Eigenvectors by subspace iteration from a fixed start; the largest entry of each is
/// positive, so the result is deterministic. Throws Error{input} for anything that is no distance matrix of 3
/// points or more. O(#V^2) per product with a vector.
Embedding classical_mds(const Eigen::MatrixXd& distances);

struct SmacofOptions {
  int max_iterations = 300;  ///< >= 1
  double tolerance = 1e-5;   ///< relative change of stress to stop at, > 0
  double relaxation =
      1.0;  ///< step in units of the majorisation's own, 1 to below 2; near 2 it halves the iterations
};

/// SMACOF (de Leeuw 1977): majorisation of the raw stress from a start (#V x 2). Stress never rises (with
/// relaxed steps too: de Leeuw and Heiser 1980). In
/// parallel; the same bytes on any number of threads. O(#V^2) per iteration. Throws Error{input} as
/// classical_mds, Error{configuration} for options out of range.
Embedding smacof(const Eigen::MatrixXd& distances, const Points2& start, const SmacofOptions& options = {},
                 const Monitor& monitor = {});

/// Landmark scaling (de Silva and Tenenbaum 2004): SMACOF among the landmarks, then triangulation of the
/// rest, each refined by majorising its own stress to the landmarks. `landmark_distances` is #V x #L (#L >=
/// 3), `landmarks` the vertex of each column. Stress is over landmark-vertex pairs. Deterministic. O(#L #V)
/// per step.
Embedding landmark_mds(const Eigen::MatrixXd& landmark_distances, const std::vector<int>& landmarks,
                       const SmacofOptions& options = {}, const Monitor& monitor = {});

}  // namespace wilt
