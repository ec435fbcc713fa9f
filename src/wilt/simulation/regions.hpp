// The regions of a leaf that forces are reported for (paper, figure 9).
#pragma once

#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/result.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// The region of each vertex: a tip and its one-ring; else a vertex within half a mean edge of a primary
/// vein; else a margin vertex; else mesophyll.
VertexData<Region> leaf_regions(const Leaf& leaf, const Venation& venation);

/// A row per region with the means over its vertices; a region without vertices has none.
std::vector<ForceRow> force_rows(const VertexData<Region>& regions, const DeformationModel& model,
                                 const Points3& x, const Points3& v, int iteration);

}  // namespace wilt
