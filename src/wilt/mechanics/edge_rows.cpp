#include "wilt/mechanics/edge_rows.hpp"

#include <algorithm>
#include <utility>

#include "wilt/core/index_lists.hpp"
#include "wilt/mechanics/breadth_first.hpp"

namespace wilt::detail {
namespace {

using simd::kLanes;

// The ends of edges at each vertex, as edges.data() has them.
IndexLists ends_at_vertices(int vertex_count, const Edges& edges) {
  std::vector<std::pair<int, int>> ends;
  ends.reserve(edges.size());
  for (int end = 0; end < edges.size(); ++end) ends.emplace_back(edges.data()[end], end);
  return {vertex_count, ends};
}

int other_vertex(const Edges& edges, int end) {
  return edges.data()[end ^ 1];
}

// Vertices breadth first, component by component, each from the last vertex that a first walk reaches.
std::vector<int> breadth_first(int vertex_count, const Edges& edges, const IndexLists& ends) {
  const auto neighbours = [&](int v, const auto& visit) {
    for (const int end : ends[v]) visit(other_vertex(edges, end));
  };
  std::vector<int> order, seen(vertex_count, 0);
  order.reserve(vertex_count);
  for (int v = 0; v < vertex_count; ++v) {
    if (seen[v]) continue;
    const std::size_t first = order.size();
    append_breadth_first(v, 1, neighbours, seen, order);
    const int last = order.back();
    order.resize(first);
    append_breadth_first(last, 2, neighbours, seen, order);
  }
  return order;
}

}  // namespace

EdgeRows::EdgeRows(int vertex_count, const Edges& edges)
    : vertices((vertex_count + kLanes - 1) / kLanes * kLanes), rows(vertex_count) {
  const IndexLists ends_of = ends_at_vertices(vertex_count, edges);
  const std::vector<int> order = breadth_first(vertex_count, edges, ends_of);
  std::copy(order.begin(), order.end(), vertices.begin());
  std::fill(vertices.begin() + vertex_count, vertices.end(), order.empty() ? 0 : order.back());
  for (int r = 0; r < vertex_count; ++r) rows[vertices[r]] = r;
  group_begin.push_back(0);
  for (int first = 0; first < row_count(); first += kLanes) {
    int width = 0;
    const int filled_rows = std::min(kLanes, vertex_count - first);
    for (int l = 0; l < filled_rows; ++l)
      width = std::max(width, static_cast<int>(ends_of[vertices[first + l]].size()));
    for (int slot = 0; slot < width; ++slot) {
      for (int l = 0; l < kLanes; ++l) {
        const auto own = ends_of[vertices[first + l]];
        const bool filled = l < filled_rows && slot < static_cast<int>(own.size());
        const int end = filled ? own[slot] : -1;
        ends.push_back(end);
        neighbours.push_back(filled ? rows[other_vertex(edges, end)] : first + l);
      }
    }
    group_begin.push_back(group_begin.back() + width);
  }
}

}  // namespace wilt::detail
