#include "wilt/geodesics/unfolding.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

// Round-off of the sum of a vertex's angles: a flat vertex is no saddle.
constexpr double kFlat = 1e-12;

HalfedgeFrame make_frame(const Vec3& a, const Vec3& b, const Vec3& c) {
  HalfedgeFrame frame;
  frame.length = (b - a).norm();
  const Vec3 axis = (b - a) / frame.length;
  frame.apex = {(c - a).dot(axis), (c - a).cross(axis).norm()};
  frame.right = (Vec2(frame.length, 0.0) - frame.apex).normalized();
  frame.left = frame.apex.normalized();
  return frame;
}

}  // namespace

Unfolding::Unfolding(const SurfaceMesh& mesh, const Points3& positions) {
  if (positions.rows() != mesh.num_vertices())
    throw Error(ErrorCode::input,
                fmt::format("{} positions were given for a mesh of {} vertices; give one each",
                            positions.rows(), mesh.num_vertices()));
  const int interior = 3 * mesh.num_faces();
  frames_.resize(interior);
  lengths_.resize(mesh.num_halfedges());
  for (int i = 0; i < interior; ++i) {
    const HalfedgeId h(i);
    const VertexId a = mesh.from(h), b = mesh.to(h), c = mesh.to(mesh.next(h));
    frames_[h] = make_frame(positions.row(a), positions.row(b), positions.row(c));
    if (!(frames_[h].apex.y() > 0.0 && frames_[h].length > 0.0 &&
          std::isfinite(frames_[h].apex.squaredNorm())))
      throw Error(ErrorCode::input,
                  fmt::format("face {} (vertices {}, {}, {}) has no area or a position that is not finite; "
                              "distances need proper triangles",
                              int(mesh.face(h)), int(a), int(b), int(c)));
    lengths_[h] = lengths_[mesh.twin(h)] = frames_[h].length;
    mean_length_ += frames_[h].length / interior;
  }

  angles_.assign(mesh.num_halfedges(), 0.0);
  total_angles_.assign(mesh.num_vertices(), 0.0);
  pseudo_source_.assign(mesh.num_vertices(), false);
  for (const VertexId v : mesh.vertices()) {
    double sum = 0.0;
    mesh.for_outgoing(v, [&](HalfedgeId h) {
      angles_[h] = sum;
      const HalfedgeId in = mesh.twin(h);  // its face lies between h and the next outgoing halfedge
      if (mesh.is_boundary(in)) return;
      const Vec2& apex = frames_[mesh.next(in)].apex;
      sum += std::atan2(apex.y(), apex.x());
    });
    total_angles_[v] = sum;
    pseudo_source_[v] = mesh.is_boundary(v) || sum > 2.0 * std::numbers::pi + kFlat;
  }
}

void check_vertex(const SurfaceMesh& mesh, VertexId v, const char* what) {
  if (v < 0 || v >= mesh.num_vertices())
    throw Error(ErrorCode::input, fmt::format("{} {} is no vertex of the mesh; it has vertices 0 to {}", what,
                                              int(v), mesh.num_vertices() - 1));
}

}  // namespace wilt::detail
