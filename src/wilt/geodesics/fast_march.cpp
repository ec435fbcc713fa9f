#include "wilt/geodesics/fast_march.hpp"

#include <algorithm>

namespace wilt::detail {
namespace {

// Buckets of the queue to a mean edge length. Within a bucket there is no order: a vertex that comes too
// early is swept again.
constexpr double kBuckets = 8.0;
// A path along an edge that bends at its vertex by less than this (sine) keeps its root: the gaps that
// curvature leaves between neighbouring faces are no shadows. On the margin there are none.
constexpr double kBend = 0.05;
constexpr double kBendOnMargin = 1e-6;

}  // namespace

FastMarch::FastMarch(const MarchSurface& surface)
    : surface_(surface),
      buckets_per_length_(kBuckets / surface.mean_length()),
      fronts_(surface.mesh().num_vertices()) {}

void FastMarch::add_source(VertexId v) {
  fronts_[v] = {0.0, 0.0, 0.0F, 0.0F, v};
  push(v);
}

void FastMarch::add_curve_point(HalfedgeId h, const Vec2& offset) {
  const VertexId v = surface_.mesh().from(h);
  const MarchEdge& axis = surface_.edge(h);
  const double distance = offset.norm();
  const Vec2 t = distance > 0.0 ? Vec2(offset / distance) : Vec2(Vec2::Zero());
  const float x = static_cast<float>(axis.x * t.x() - axis.y * t.y());
  const float y = static_cast<float>(axis.x * t.y() + axis.y * t.x());
  if (take(fronts_[v], {distance, distance, x, y, kCurve})) push(v);
}

void FastMarch::run(double* distances) {
  for (current_ = 0; current_ < static_cast<int>(buckets_.size()); ++current_) {
    while (buckets_[current_] >= 0) {
      const Entry entry = entries_[buckets_[current_]];
      buckets_[current_] = entry.next;
      Front& front = fronts_[entry.vertex];
      if (front.final) continue;
      front.final = true;
      sweep(VertexId(entry.vertex));
    }
  }
  current_ = 0;
  buckets_.clear();
  entries_.clear();
  for (std::size_t v = 0; v < fronts_.size(); ++v) {
    distances[v] = fronts_[v].distance;
    fronts_[v] = Front();
  }
}

void FastMarch::push(VertexId v) {
  const int index = std::max(current_, static_cast<int>(fronts_[v].distance * buckets_per_length_));
  if (index >= static_cast<int>(buckets_.size())) buckets_.resize(index + 1, -1);
  entries_.push_back({v, buckets_[index]});
  buckets_[index] = static_cast<int>(entries_.size()) - 1;
}

void FastMarch::sweep(VertexId u) {
  const SurfaceMesh& mesh = surface_.mesh();
  const double bend = mesh.is_boundary(u) ? kBendOnMargin : kBend;
  mesh.for_outgoing(u, [&](HalfedgeId h) {
    const VertexId v = mesh.to(h);
    if (along_edge(fronts_[u], u, bend, surface_.edge(h), surface_.edge(mesh.twin(h)), fronts_[v])) push(v);
    if (mesh.is_boundary(h)) return;
    // face(h) = (u, a, b): b across the edge u a, and a across the edge b u.
    across(h);
    across(mesh.prev(h));
  });
}

// The vertex opposite h from the two vertices of h, of which one has just become final.
void FastMarch::across(HalfedgeId h) {
  const SurfaceMesh& mesh = surface_.mesh();
  const HalfedgeId back = mesh.twin(h);
  const Front &a = fronts_[mesh.from(h)], &b = fronts_[mesh.from(back)];
  if (!a.final || !b.final) return;
  const VertexId v = mesh.from(mesh.prev(h));
  Front& apex = fronts_[v];
  const MarchFace& face = surface_.face(h);
  const MarchEdge& edge = surface_.edge(h);
  // Only beyond an obtuse corner does a front come to an apex before it comes to both ends of the edge.
  const bool obtuse = face.apex_x * (edge.length - face.apex_x) > face.apex_y * face.apex_y;
  const double latest = obtuse ? std::min(a.distance, b.distance) : std::max(a.distance, b.distance);
  if (apex.distance <= latest) return;
  if (across_face(a, b, face, edge, surface_.edge(back), apex)) push(v);
}

}  // namespace wilt::detail
