#include "wilt/mechanics/edge_stiffness.hpp"

#include <algorithm>

#include "wilt/core/check.hpp"
#include "wilt/core/parallel.hpp"

namespace wilt::detail {
namespace {

using simd::kLanes;

constexpr int kGroups = 128;  // of edges,
constexpr int kRows = 256;    // and rows per parallel task

struct Pass {
  int edge_count;
  const int* ends;
  const double *x, *stretch, *push0, *push1, *damping;
  double position_scale, velocity_scale;
  bool semidefinite;

  // Eight numbers from the group's first edge on, 0 behind the last edge.
  WILT_INLINE Double8 load(const double* of_edges, int group) const {
    const int first = kLanes * group;
    if (first + kLanes <= edge_count) return simd::load(of_edges + first);
    Double8 lanes{};
    for (int l = 0; l < edge_count - first; ++l) lanes[l] = of_edges[first + l];
    return lanes;
  }
};

WILT_CLONES void stiffness_of_groups(const Pass& pass, int begin, int end, StiffEdge* edges) {
  Point4 directions[kLanes], stiffness[kLanes];
  for (int g = begin; g < end; ++g) {
    const int* ends = pass.ends + 2 * kLanes * g;
    const Point8 edge = simd::gather(pass.x, ends + kLanes) - simd::gather(pass.x, ends);
    const Double8 per_length = 1.0 / simd::sqrt(dot(edge, edge) + simd::kTiny);
    const Double8 stretch = pass.load(pass.stretch, g);
    Double8 along = stretch;
    Double8 across0 = stretch - per_length * pass.load(pass.push0, g);
    Double8 across1 = stretch - per_length * pass.load(pass.push1, g);
    if (pass.semidefinite) {
      along = simd::larger(along, Double8{});
      across0 = across1 = simd::larger(0.5 * (across0 + across1), Double8{});
    }
    const Double8 drag = pass.velocity_scale * pass.load(pass.damping, g);
    simd::store_points(directions, per_length * edge);
    simd::store_points(stiffness,
                       pass.position_scale * Point8{along, across0, across1} + Point8{drag, drag, drag});
    for (int l = 0; l < kLanes; ++l) {
      edges[kLanes * g + l].direction.xyz = __builtin_convertvector(directions[l].xyz, Single4);
      edges[kLanes * g + l].stiffness.xyz = __builtin_convertvector(stiffness[l].xyz, Single4);
    }
  }
}

// block += (along - across) n n^T + across I.
WILT_INLINE void add_edge(SingleBlock& block, Single4 n, float along, float across) {
  for (int k = 0; k < 3; ++k) {
    block.columns[k] += (along - across) * (n[k] * n);  // in this order: symmetric to the last bit
    block.columns[k][k] += across;
  }
}

WILT_CLONES void add_to_rows(const BlockPattern& pattern, const int* slot_edges, const StiffEdge* edges,
                             int begin, int end, float* blocks) {
  for (int r = begin; r < end; ++r) {
    const int diagonal = pattern.diagonal(r);
    SingleBlock own = load_block(blocks, diagonal);
    for (int s = pattern.row_begin(r); s < pattern.row_begin(r + 1); ++s) {
      const int at = slot_edges[s];
      if (at < 0) continue;
      const Single4 n = edges[at / 2].direction.xyz, k = edges[at / 2].stiffness.xyz;
      SingleBlock block = load_block(blocks, s);
      add_edge(block, n, -k[0], -0.5f * (k[1] + k[2]));
      store_block(blocks, s, block);
      add_edge(own, n, k[0], k[1 + at % 2]);
    }
    store_block(blocks, diagonal, own);
  }
}

}  // namespace

EdgeStiffness::EdgeStiffness(const Stencil& edges, const BlockPattern& pattern)
    : edge_count_(static_cast<int>(edges.rows())), slot_edges_(pattern.slot_count(), -1) {
  const int groups = (edge_count_ + kLanes - 1) / kLanes;
  edges_.resize(kLanes * static_cast<std::size_t>(groups));
  for (int g = 0; g < groups; ++g) {
    for (int k = 0; k < 2; ++k) {
      for (int l = 0; l < kLanes; ++l) ends8_.push_back(edges(std::min(kLanes * g + l, edge_count_ - 1), k));
    }
  }
  for (int e = 0; e < edge_count_; ++e) {
    for (int k = 0; k < 2; ++k) {
      const int slot = pattern.slot(edges(e, k), edges(e, 1 - k));
      WILT_CHECK(slot >= 0, edges(e, 0), edges(e, 1));
      slot_edges_[slot] = 2 * e + k;
    }
  }
}

void EdgeStiffness::add(const EdgeLaw& law, const Points3& x, double position_scale, double velocity_scale,
                        Curvature curvature, BlockMatrix& matrix) {
  const Pass pass{edge_count_,        ends8_.data(),
                  x.data(),           law.stretch.data(),
                  law.push.data(),    law.push.data() + edge_count_,
                  law.damping.data(), position_scale,
                  velocity_scale,     curvature == Curvature::semidefinite};
  parallel_for(static_cast<int>(edges_.size()) / kLanes, kGroups,
               [&](int begin, int end) { stiffness_of_groups(pass, begin, end, edges_.data()); });
  const BlockPattern& pattern = matrix.pattern();
  parallel_for(pattern.vertex_count(), kRows, [&](int begin, int end) {
    add_to_rows(pattern, slot_edges_.data(), edges_.data(), begin, end, matrix.values());
  });
}

}  // namespace wilt::detail
