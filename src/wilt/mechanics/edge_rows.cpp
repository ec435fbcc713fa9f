#include "wilt/mechanics/edge_rows.hpp"

#include <algorithm>
#include <numeric>

namespace wilt::detail {
namespace {

using simd::kLanes;

// The edge ends at each vertex: those of vertex v are ends[begin[v]] to ends[begin[v + 1]].
struct Incidence {
  std::vector<int> begin, ends;

  Incidence(int vertex_count, const Edges& edges) : begin(vertex_count + 1, 0), ends(edges.size()) {
    for (int k = 0; k < edges.size(); ++k) ++begin[edges.data()[k] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (int k = 0; k < edges.size(); ++k) ends[next[edges.data()[k]]++] = k;
  }
  int degree(int v) const { return begin[v + 1] - begin[v]; }
};

int other_vertex(const Edges& edges, int end) {
  return edges.data()[end ^ 1];
}

// Vertices breadth first, component by component, each from the last vertex that a first walk reaches.
std::vector<int> breadth_first(const Edges& edges, const Incidence& incidence) {
  const int n = static_cast<int>(incidence.begin.size()) - 1;
  std::vector<int> order, seen(n, 0);
  order.reserve(n);
  const auto walk = [&](int start, int mark) {
    const std::size_t first = order.size();
    order.push_back(start);
    seen[start] = mark;
    for (std::size_t k = first; k < order.size(); ++k) {
      const int v = order[k];
      for (int s = incidence.begin[v]; s < incidence.begin[v + 1]; ++s) {
        const int w = other_vertex(edges, incidence.ends[s]);
        if (seen[w] == mark) continue;
        seen[w] = mark;
        order.push_back(w);
      }
    }
    return first;
  };
  for (int v = 0; v < n; ++v) {
    if (seen[v]) continue;
    const std::size_t first = walk(v, 1);
    const int last = order.back();
    order.resize(first);
    walk(last, 2);
  }
  return order;
}

}  // namespace

EdgeRows::EdgeRows(int vertex_count, const Edges& edges)
    : vertices((vertex_count + kLanes - 1) / kLanes * kLanes), rows(vertex_count) {
  const Incidence incidence(vertex_count, edges);
  const std::vector<int> order = breadth_first(edges, incidence);
  std::copy(order.begin(), order.end(), vertices.begin());
  std::fill(vertices.begin() + vertex_count, vertices.end(), order.empty() ? 0 : order.back());
  for (int r = 0; r < vertex_count; ++r) rows[vertices[r]] = r;
  group_begin.push_back(0);
  for (int first = 0; first < row_count(); first += kLanes) {
    int width = 0;
    const int filled_rows = std::min(kLanes, vertex_count - first);
    for (int l = 0; l < filled_rows; ++l) width = std::max(width, incidence.degree(vertices[first + l]));
    for (int slot = 0; slot < width; ++slot) {
      for (int l = 0; l < kLanes; ++l) {
        const int v = vertices[first + l];
        const bool filled = l < filled_rows && slot < incidence.degree(v);
        const int end = filled ? incidence.ends[incidence.begin[v] + slot] : -1;
        ends.push_back(end);
        neighbours.push_back(filled ? rows[other_vertex(edges, end)] : first + l);
      }
    }
    group_begin.push_back(group_begin.back() + width);
  }
}

}  // namespace wilt::detail
