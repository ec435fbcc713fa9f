// How wrinkled a blade is.
#pragma once

#include <array>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// RMS over vertices at least two rings inside of the distance, along the local normal, from the vertex to
/// the least-squares quadric through the vertices around it, over L.
///
/// Around it: connected with it through vertices within rest distance 0.1 L. On meshes of more than 5,000
/// vertices as many of them, taken evenly in their order, stand for all; two of them are then connected where
/// the parts of the mesh nearer to one than to any other touch. At most 4,000 centres and 150 vertices around
/// each count, taken evenly too. Setting up is O(#V), measuring does not depend on #V.
class WrinkleMeter {
 public:
  /// `rest` #V x 3 in any unit, `length` L in that unit; the mesh must outlive this object.
  WrinkleMeter(const SurfaceMesh& mesh, const Points3& rest, double length);

  /// `positions` #V x 3. Deterministic; 0 for a mesh too coarse to have a centre with nine vertices around
  /// it.
  double operator()(const Points3& positions) const;

 private:
  struct Stencil {
    int centre;
    std::vector<int> around;
  };
  /// Eight stencils side by side: step k of the indices holds the k-th vertex around each centre, and the
  /// centre itself where there are no more.
  struct Group {
    std::array<int, 8> centres, counts;
    std::size_t first;  // in indices_
    int steps;
  };
  void pack(const std::vector<Stencil>& stencils);

  const SurfaceMesh& mesh_;
  double length_;
  int centre_count_ = 0;
  std::vector<Group> groups_;
  std::vector<int> indices_;
};

}  // namespace wilt
