// Coarser meshes on vertices of the leaf's own, so that one animation serves them all.
#pragma once

#include <vector>

#include "wilt/output/moving.hpp"

namespace wilt {

/// A mesh with fewer triangles.
struct DetailLevel {
  Faces faces;  ///< of vertices of the full mesh
  double deviation =
      0.0;  ///< coordinates of the file: how far any vertex of the full mesh is from it, in any frame
};

/// `count` levels, each with half the triangles of the one before, or as many as it takes.
///
/// meshoptimizer's quadric edge collapses on the last of `frames` frames, where the leaf is most wrinkled.
/// The vertices of the margin and of holes all stay, so the outline is that of the full mesh, and no level
/// can have fewer triangles than they ask for. O(#frames #V log #V). Deterministic.
std::vector<DetailLevel> levels_of_detail(const Moving& mesh, int frames, int count);

}  // namespace wilt
