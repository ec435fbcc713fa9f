// The edges at every vertex, eight vertices side by side (internal).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/simd.hpp"
#include "wilt/core/types.hpp"

namespace wilt::detail {

/// Sliced ELLPACK (Monakov, Lokhmotov and Avetisyan 2010): a row is a vertex, a group is eight rows in a row,
/// and a slot of a group holds one neighbour of each of its rows. A pass over a group gathers and writes
/// nothing but its own rows: so it needs no colours, and gives the same bytes on any number of threads.
///
/// Rows are numbered breadth first (Cuthill and McKee 1969), so neighbours are near in memory however the
/// mesh is numbered.
struct EdgeRows {
  EdgeRows(int vertex_count, const Edges& edges);

  int vertex_count() const { return static_cast<int>(rows.size()); }
  int row_count() const { return static_cast<int>(vertices.size()); }  ///< a multiple of 8
  int group_count() const { return row_count() / simd::kLanes; }
  int slot_count() const { return group_begin.back(); }

  std::vector<int> vertices;     ///< per row its vertex; the last one again past the last row
  std::vector<int> rows;         ///< per vertex its row
  std::vector<int> group_begin;  ///< per group its first slot; the last entry is the number of slots
  std::vector<int> neighbours;   ///< 8 per slot, rows; the row itself where it has no further neighbour
  std::vector<int> ends;  ///< 8 per slot, 2 edge + (0 or 1: the row is edges(edge, 0 or 1)); -1 for none
};

}  // namespace wilt::detail
