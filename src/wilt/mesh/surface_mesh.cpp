#include "wilt/mesh/surface_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

namespace wilt {
namespace {

struct DirectedEdge {
  std::uint64_t key;  // smaller vertex, larger vertex
  int halfedge;
};

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::input, message);
}

void check_faces(int vertex_count, const Faces& faces) {
  if (faces.rows() == 0) fail("the mesh has no faces; a leaf needs at least one triangle");
  for (int f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (faces(f, k) < 0 || faces(f, k) >= vertex_count)
        fail(fmt::format("face {} refers to vertex {}, but the mesh has vertices 0 to {}", f, faces(f, k),
                         vertex_count - 1));
    }
    if (faces(f, 0) == faces(f, 1) || faces(f, 1) == faces(f, 2) || faces(f, 2) == faces(f, 0))
      fail(fmt::format("face {} uses a vertex twice ({}, {}, {}); remove degenerate faces", f, faces(f, 0),
                       faces(f, 1), faces(f, 2)));
  }
}

// The halfedges of all faces, sorted so that the two of an edge stand together.
std::vector<DirectedEdge> sorted_halfedges(const Faces& faces) {
  std::vector<DirectedEdge> all(static_cast<std::size_t>(faces.rows()) * 3);
  for (int f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({faces(f, k), faces(f, (k + 1) % 3)});
      all[3 * f + k] = {static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high), 3 * f + k};
    }
  }
  std::sort(all.begin(), all.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return a.key != b.key ? a.key < b.key : a.halfedge < b.halfedge;
  });
  return all;
}

}  // namespace

SurfaceMesh::SurfaceMesh(int vertex_count, const Faces& faces) : faces_(faces) {
  check_faces(vertex_count, faces);
  const int interior = 3 * num_faces();
  next_.resize(interior);
  twin_.resize(interior);
  from_.resize(interior);
  for (int h = 0; h < interior; ++h) {
    next_[h] = HalfedgeId(h % 3 == 2 ? h - 2 : h + 1);
    from_[h] = VertexId(faces(h / 3, h % 3));
  }

  const std::vector<DirectedEdge> sorted = sorted_halfedges(faces);
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i + 1;
    while (end < sorted.size() && sorted[end].key == sorted[i].key) ++end;
    const int a = sorted[i].halfedge;
    const VertexId tail = from_[a], head = from_[next_[a]];
    if (end - i > 2)
      fail(fmt::format(
          "the edge between vertices {} and {} has {} faces ({}, {}, {}{}); a surface has at most two",
          int(tail), int(head), end - i, a / 3, sorted[i + 1].halfedge / 3, sorted[i + 2].halfedge / 3,
          end - i > 3 ? ", ..." : ""));
    if (end - i == 2) {
      const int b = sorted[i + 1].halfedge;
      if (from_[b] == tail)
        fail(
            fmt::format("faces {} and {} run along the edge from vertex {} to {} in the same direction; "
                        "turn one of them over",
                        a / 3, b / 3, int(tail), int(head)));
      twin_[a] = HalfedgeId(b);
      twin_[b] = HalfedgeId(a);
    } else {
      twin_[a] = HalfedgeId();
    }
    i = end;
  }

  // Boundary halfedges, in the order of the interior ones that they face.
  for (int h = 0; h < interior; ++h) {
    if (twin_[h].valid()) continue;
    const HalfedgeId boundary(static_cast<int>(from_.size()));
    from_.push_back(from_[next_[h]]);
    twin_.push_back(HalfedgeId(h));
    twin_[h] = boundary;
  }
  next_.resize(from_.size());

  vertex_halfedge_.assign(vertex_count, HalfedgeId());
  for (int h = 0; h < interior; ++h) {
    if (!vertex_halfedge_[from_[h]].valid()) vertex_halfedge_[from_[h]] = HalfedgeId(h);
  }
  std::vector<int> boundary_count(vertex_count, 0);
  for (int h = interior; h < num_halfedges(); ++h) {
    const VertexId v = from_[h];
    if (++boundary_count[v] > 1)
      fail(fmt::format(
          "several parts of the surface touch only at vertex {}; split that vertex or remove a part",
          int(v)));
    vertex_halfedge_[v] = HalfedgeId(h);
  }
  for (int h = interior; h < num_halfedges(); ++h) {
    next_[h] = vertex_halfedge_[from_[twin_[h]]];  // one boundary halfedge leaves every boundary vertex
  }

  prev_.resize(num_halfedges());
  for (int h = 0; h < num_halfedges(); ++h) prev_[next_[h]] = HalfedgeId(h);

  std::vector<int> fan(vertex_count, 0);
  for (int h = 0; h < interior; ++h) ++fan[from_[h]];
  for (int v = 0; v < vertex_count; ++v) {
    if (fan[v] == 0) fail(fmt::format("vertex {} belongs to no face; remove it", v));
    int reached = 0;
    for_outgoing(VertexId(v), [&](HalfedgeId h) { reached += is_boundary(h) ? 0 : 1; });
    if (reached != fan[v])
      fail(fmt::format(
          "several parts of the surface touch only at vertex {}; split that vertex or remove a part", v));
  }

  edge_.assign(num_halfedges(), EdgeId());
  edge_halfedge_.reserve(num_halfedges() / 2);
  for (int h = 0; h < interior; ++h) {
    if (edge_[h].valid()) continue;
    edge_[h] = edge_[twin_[h]] = EdgeId(num_edges());
    edge_halfedge_.push_back(HalfedgeId(h));
  }

  std::vector<bool> seen(num_halfedges(), false);
  for (int first = interior; first < num_halfedges(); ++first) {
    if (seen[first]) continue;
    std::vector<VertexId>& loop = boundary_loops_.emplace_back();
    for (HalfedgeId h(first); !seen[h]; h = next_[h]) {
      seen[h] = true;
      loop.push_back(from_[h]);
    }
  }
}

Edges SurfaceMesh::edge_matrix() const {
  Edges result(num_edges(), 2);
  for (const EdgeId e : edges()) result.row(e) << int(from(halfedge(e))), int(to(halfedge(e)));
  return result;
}

std::vector<VertexId> SurfaceMesh::one_ring(VertexId v) const {
  std::vector<VertexId> ring;
  for_outgoing(v, [&](HalfedgeId h) { ring.push_back(to(h)); });
  return ring;
}

VertexData<int> SurfaceMesh::components(int* count) const {
  VertexData<int> component(num_vertices(), -1);
  std::vector<VertexId> stack;
  *count = 0;
  for (const VertexId seed : vertices()) {
    if (component[seed] >= 0) continue;
    component[seed] = *count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const VertexId v = stack.back();
      stack.pop_back();
      for_outgoing(v, [&](HalfedgeId h) {
        if (component[to(h)] >= 0) return;
        component[to(h)] = *count;
        stack.push_back(to(h));
      });
    }
    ++*count;
  }
  return component;
}

}  // namespace wilt
