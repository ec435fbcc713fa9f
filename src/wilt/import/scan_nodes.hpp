// A scan reduced to nodes that know their neighbours. Inside the import room only.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/import/scan_cleaning.hpp"

namespace wilt::detail {

struct NodeLink {
  int node;
  double length;
};

struct ScanNodes {
  Points3 places;                            ///< #N x 3
  Points3 normals;                           ///< #N x 3, either side
  std::vector<std::vector<NodeLink>> links;  ///< #N, to the nodes near on the same sheet
  std::vector<int> of_point;                 ///< the node of each point of the scan
  double spacing = 0.0;                      ///< no two nodes are nearer
};

/// Nodes at least 1.6 spacings apart and about 2500 at most, on the smoothed points. Links leave out what
/// leads across the surface rather than along it.
ScanNodes pick_nodes(const CleanScan& scan);

/// The connected pieces, largest first, each in ascending order of nodes.
std::vector<std::vector<int>> pieces_of(const ScanNodes& nodes);

/// One piece alone; points of others get node -1.
ScanNodes only_piece(const ScanNodes& nodes, const std::vector<int>& piece);

/// Lengths of the shortest paths over the links from every one of `count` nodes spread over them (each the
/// farthest from those before) to all: #N x count; `chosen` tells which. The nodes are one piece.
Eigen::MatrixXd spread_distances(const ScanNodes& nodes, int count, std::vector<int>& chosen);

}  // namespace wilt::detail
