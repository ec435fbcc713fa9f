#include "wilt/mechanics/spring_network.hpp"

#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

using detail::EdgeRows;
using simd::kLanes;

constexpr int kGroups = 128;  // per parallel task

// Public vectors in the rows' order.
std::vector<Point4> in_rows(const EdgeRows& rows, const Points3& values) {
  std::vector<Point4> result(rows.row_count());
  for (int r = 0; r < rows.row_count(); ++r) {
    const double* p = values.data() + 3 * static_cast<std::ptrdiff_t>(rows.vertices[r]);
    result[r].xyz = Double4{p[0], p[1], p[2], 0.0};
  }
  return result;
}

struct Pass {
  const EdgeRows* rows;
  const Number8 *stretch, *push, *damping;
  const Point4 *x, *v;
};

WILT_CLONES void force_on_groups(const Pass& pass, int begin, int end, Point4* force) {
  for (int g = begin; g < end; ++g) {
    const Point8 xi = simd::load_points(pass.x + kLanes * g), vi = simd::load_points(pass.v + kLanes * g);
    Point8 f;
    for (int s = pass.rows->group_begin[g]; s < pass.rows->group_begin[g + 1]; ++s) {
      const int* neighbours = pass.rows->neighbours.data() + kLanes * s;
      const Point8 edge = simd::gather(pass.x, neighbours) - xi;
      const Double8 length = simd::sqrt(dot(edge, edge) + simd::kTiny);
      const Double8 pull = pass.stretch[s].lanes - pass.push[s].lanes / length;
      f = f + pull * edge + pass.damping[s].lanes * (simd::gather(pass.v, neighbours) - vi);
    }
    simd::store_points(force + kLanes * g, f);
  }
}

}  // namespace

SpringNetwork::SpringNetwork(int vertex_count, const Edges& edges)
    : edge_count_(static_cast<int>(edges.rows())),
      rows_(vertex_count, edges),
      stretch_(rows_.slot_count()),
      push_(rows_.slot_count()),
      damping_(rows_.slot_count()) {}

void SpringNetwork::set_law(const EdgeLaw& law) {
  if (law.revisions[1] != revisions_[1]) {
    detail::require_count("pairs of pushes", law.push.rows(), edge_count_);
    spread(law.push.data(), edge_count_, push_);
  }
  if (law.revisions[0] != revisions_[0]) {
    detail::require_count("stretches", law.stretch.size(), edge_count_);
    detail::require_count("dampings", law.damping.size(), edge_count_);
    spread(law.stretch.data(), 0, stretch_);
    spread(law.damping.data(), 0, damping_);
    damped_ = (law.damping.array() != 0.0).any();
  }
  revisions_ = law.revisions;
}

// To every slot the value of its edge's end: of_edge[edge + stride * (0 or 1)].
void SpringNetwork::spread(const double* of_edge, int stride, std::vector<Number8>& slots) const {
  parallel_for(rows_.slot_count(), kLanes * kGroups, [&](int begin, int end) {
    for (int s = begin; s < end; ++s) {
      for (int l = 0; l < kLanes; ++l) {
        const int at = rows_.ends[kLanes * s + l];
        slots[s].lanes[l] = at < 0 ? 0.0 : of_edge[at / 2 + static_cast<std::ptrdiff_t>(stride) * (at % 2)];
      }
    }
  });
}

void SpringNetwork::add_force(const Points3& x, const Points3& v, Points3& force) const {
  const std::vector<Point4> positions = in_rows(rows_, x), velocities = in_rows(rows_, v);
  std::vector<Point4> sums(rows_.row_count());
  const Pass pass{&rows_, stretch(), push(), damping(), positions.data(), velocities.data()};
  parallel_for(rows_.group_count(), kGroups,
               [&](int begin, int end) { force_on_groups(pass, begin, end, sums.data()); });
  for (int r = 0; r < rows_.vertex_count(); ++r) {
    for (int k = 0; k < 3; ++k) force(rows_.vertices[r], k) += sums[r].xyz[k];
  }
}

}  // namespace wilt
