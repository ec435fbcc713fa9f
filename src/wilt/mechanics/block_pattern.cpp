#include "wilt/mechanics/block_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mechanics/breadth_first.hpp"

namespace wilt {
namespace {

using Graph = std::vector<std::vector<int>>;  // the neighbours of each vertex, itself included, sorted

Graph coupled_vertices(int vertex_count, const std::vector<Stencil>& stencils) {
  Graph graph(vertex_count);
  for (int i = 0; i < vertex_count; ++i) graph[i].push_back(i);
  for (const Stencil& stencil : stencils) {
    for (int e = 0; e < stencil.rows(); ++e) {
      for (int a = 0; a < stencil.cols(); ++a) {
        const int i = stencil(e, a);
        if (i < 0 || i >= vertex_count)
          throw Error(
              ErrorCode::input,
              fmt::format("element {} uses vertex {}; there are {} vertices, from 0", e, i, vertex_count));
      }
      for (int a = 0; a < stencil.cols(); ++a) {
        for (int b = 0; b < stencil.cols(); ++b) {
          if (a != b) graph[stencil(e, a)].push_back(stencil(e, b));
        }
      }
    }
  }
  for (auto& row : graph) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return graph;
}

std::vector<int> breadth_first(const Graph& graph) {
  const auto neighbours = [&](int i, const auto& visit) {
    for (const int j : graph[i]) visit(j);
  };
  std::vector<int> order, seen(graph.size(), 0);
  order.reserve(graph.size());
  for (std::size_t start = 0; start < graph.size(); ++start) {
    if (!seen[start]) detail::append_breadth_first(static_cast<int>(start), 1, neighbours, seen, order);
  }
  return order;
}

// To each vertex, in the given order, the first colour that none of its neighbours has.
std::vector<int> greedy_colours(const Graph& graph, const std::vector<int>& order) {
  std::vector<int> colours(graph.size(), -1);
  std::vector<int> taken_by;  // per colour, the last vertex that could not have it
  for (const int i : order) {
    for (const int j : graph[i]) {
      if (colours[j] >= 0) taken_by[colours[j]] = i;
    }
    const auto free = std::find_if(taken_by.begin(), taken_by.end(), [i](int by) { return by != i; });
    colours[i] = static_cast<int>(free - taken_by.begin());
    if (free == taken_by.end()) taken_by.push_back(-1);
  }
  return colours;
}

}  // namespace

BlockPattern::BlockPattern(int vertex_count, const std::vector<Stencil>& stencils)
    : rows_(vertex_count), diagonal_(vertex_count) {
  const Graph graph = coupled_vertices(vertex_count, stencils);
  vertices_ = breadth_first(graph);
  const std::vector<int> colours = greedy_colours(graph, vertices_);
  std::stable_sort(vertices_.begin(), vertices_.end(), [&](int i, int j) { return colours[i] < colours[j]; });
  row_begin_.push_back(0);
  for (int r = 0; r < vertex_count; ++r) {
    rows_[vertices_[r]] = r;
    if (r == 0 || colours[vertices_[r]] != colours[vertices_[r - 1]]) colour_begin_.push_back(r);
  }
  colour_begin_.push_back(vertex_count);
  for (int r = 0; r < vertex_count; ++r) {
    for (const int j : graph[vertices_[r]]) columns_.push_back(rows_[j]);
    std::sort(columns_.begin() + row_begin_[r], columns_.end());
    row_begin_.push_back(static_cast<int>(columns_.size()));
  }
  mirror_.resize(columns_.size());
  for (int r = 0; r < vertex_count; ++r) {
    diagonal_[r] = slot(vertices_[r], vertices_[r]);
    for (int s = row_begin_[r]; s < row_begin_[r + 1]; ++s)
      mirror_[s] = slot(vertices_[columns_[s]], vertices_[r]);
  }
}

int BlockPattern::slot(int i, int j) const {
  const int row = rows_[i];
  const auto begin = columns_.begin() + row_begin_[row], end = columns_.begin() + row_begin_[row + 1];
  const auto found = std::lower_bound(begin, end, rows_[j]);
  return found == end || *found != rows_[j] ? -1 : static_cast<int>(found - columns_.begin());
}

Stencil BlockPattern::pair_slots(const Stencil& stencil) const {
  const int k = static_cast<int>(stencil.cols());
  Stencil slots(stencil.rows(), k * (k + 1) / 2);
  for (int e = 0; e < stencil.rows(); ++e) {
    int pair = 0;
    for (int a = 0; a < k; ++a) {
      for (int b = a; b < k; ++b, ++pair) {
        slots(e, pair) = slot(stencil(e, a), stencil(e, b));
        WILT_CHECK(slots(e, pair) >= 0, stencil(e, a), stencil(e, b));
      }
    }
  }
  return slots;
}

}  // namespace wilt
