#include "wilt/geodesics/fast_geodesics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "wilt/core/error.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/fast_march.hpp"

namespace wilt {
namespace {

using detail::FastMarch;
using detail::MarchFace;
using detail::MarchSurface;

// Sources between two looks at the monitor.
constexpr int kBlock = 64;
// Of the matrix; two tiles stay in the first cache.
constexpr int kTile = 64;

void check_point(const SurfaceMesh& mesh, const SurfacePoint& point) {
  const Vec3& w = point.barycentric;
  if (point.face < 0 || point.face >= mesh.num_faces() || !(w.minCoeff() >= -1e-9) ||
      !(std::abs(w.sum() - 1.0) <= 1e-9))
    throw Error(
        ErrorCode::input,
        fmt::format("a source path has the point ({}, {}, {}) in face {}; its coordinates must be >= 0 "
                    "and sum to 1, in a face from 0 to {}",
                    w[0], w[1], w[2], int(point.face), mesh.num_faces() - 1));
}

// The three halfedges of a face.
std::array<HalfedgeId, 3> halfedges(const SurfaceMesh& mesh, FaceId f) {
  const HalfedgeId h = mesh.halfedge(f);
  return {h, mesh.next(h), mesh.prev(h)};
}

// A point of the face of h in the frame of h.
Vec2 in_frame(const MarchSurface& surface, HalfedgeId h, const SurfacePoint& point) {
  const MarchFace& face = surface.face(h);
  const int k = h - surface.mesh().halfedge(point.face);
  return point.barycentric[(k + 1) % 3] * Vec2(surface.edge(h).length, 0.0) +
         point.barycentric[(k + 2) % 3] * Vec2(face.apex_x, face.apex_y);
}

// Seeds the corners of a face with the segment a b in it.
void seed_segment(const MarchSurface& surface, const SurfacePoint& a, const SurfacePoint& b,
                  FastMarch& march) {
  for (const HalfedgeId h : halfedges(surface.mesh(), a.face)) {
    // In the frame of h its first vertex is the origin; the face lies counter-clockwise from h.
    const Vec2 p = in_frame(surface, h, a), q = in_frame(surface, h, b);
    const double squared = (q - p).squaredNorm();
    const double t = squared > 0.0 ? std::clamp(-p.dot(q - p) / squared, 0.0, 1.0) : 0.0;
    const Vec2 nearest = p + t * (q - p);
    march.add_curve_point(h, nearest);
  }
}

void seed_path(const MarchSurface& surface, const SurfacePath& path, FastMarch& march) {
  const SurfaceMesh& mesh = surface.mesh();
  for (const SurfacePoint& point : path.points) check_point(mesh, point);
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const SurfacePoint& a = path.points[i];
    const SurfacePoint& b = path.points[std::min(i + 1, path.points.size() - 1)];
    bool together = false;
    for (const FaceId f : faces_at(mesh, a)) {
      if (!lies_in(mesh, b, f)) continue;
      together = true;
      seed_segment(surface, in_face(mesh, a, f), in_face(mesh, b, f), march);
    }
    if (!together)
      throw Error(ErrorCode::input,
                  fmt::format("points {} and {} of a source path lie in faces {} and {} and share no "
                              "face; split the segment where it crosses edges",
                              i, i + 1, int(a.face), int(b.face)));
  }
}

// Averages the matrix with its transpose, tile by tile.
void make_symmetric(Eigen::MatrixXd& matrix) {
  const int n = static_cast<int>(matrix.rows()), tiles = (n + kTile - 1) / kTile;
  parallel_for(tiles, 1, [&](int begin, int end) {
    for (int i = begin * kTile; i < std::min(n, end * kTile); i += kTile) {
      for (int j = i; j < n; j += kTile) {
        const int rows = std::min(kTile, n - j), columns = std::min(kTile, n - i);
        const Eigen::MatrixXd mean =
            0.5 * (matrix.block(j, i, rows, columns) + matrix.block(i, j, columns, rows).transpose());
        matrix.block(j, i, rows, columns) = mean;
        matrix.block(i, j, columns, rows) = mean.transpose();
      }
    }
  });
}

// Calls rows(first, last) for all sources in blocks, in parallel within a block; the monitor is asked between
// blocks.
void for_sources(int count, const Monitor& monitor, const std::function<void(int, int)>& rows) {
  for (int begin = 0; begin < count; begin += kBlock) {
    monitor.throw_if_cancelled();
    monitor.report("geodesics", static_cast<double>(begin) / count);
    const int size = std::min(kBlock, count - begin);
    parallel_for(size, 1, [&](int first, int last) { rows(begin + first, begin + last); });
  }
  monitor.report("geodesics", 1.0);
}

}  // namespace

FastGeodesics::FastGeodesics(const SurfaceMesh& mesh, const Points3& positions)
    : mesh_(mesh), surface_(std::make_shared<const MarchSurface>(mesh, detail::Unfolding(mesh, positions))) {}

Eigen::VectorXd FastGeodesics::distances(VertexId source) const {
  return distances(std::span<const VertexId>(&source, 1));
}

Eigen::MatrixXd FastGeodesics::distances(std::span<const VertexId> sources, const Monitor& monitor) const {
  for (const VertexId v : sources) detail::check_vertex(mesh_, v, "the source");
  Eigen::MatrixXd result(mesh_.num_vertices(), sources.size());
  for_sources(static_cast<int>(sources.size()), monitor, [&](int first, int last) {
    FastMarch march(*surface_);
    for (int i = first; i < last; ++i) {
      march.add_source(sources[i]);
      march.run(result.col(i).data());
    }
  });
  return result;
}

Eigen::VectorXd FastGeodesics::distances(std::span<const SurfacePath> sources) const {
  FastMarch march(*surface_);
  for (const SurfacePath& path : sources) seed_path(*surface_, path, march);
  Eigen::VectorXd result(mesh_.num_vertices());
  march.run(result.data());
  return result;
}

Eigen::MatrixXd geodesic_distances(const SurfaceMesh& mesh, const Points3& positions,
                                   std::span<const VertexId> sources, GeodesicMethod method,
                                   const Monitor& monitor) {
  if (method == GeodesicMethod::fast) return FastGeodesics(mesh, positions).distances(sources, monitor);
  const ExactGeodesics exact(mesh, positions);
  for (const VertexId v : sources) detail::check_vertex(mesh, v, "the source");
  Eigen::MatrixXd result(mesh.num_vertices(), sources.size());
  for_sources(static_cast<int>(sources.size()), monitor, [&](int first, int last) {
    for (int i = first; i < last; ++i) result.col(i) = exact.distances(sources[i]);
  });
  return result;
}

Eigen::MatrixXd all_pairs(const SurfaceMesh& mesh, const Points3& positions, GeodesicMethod method,
                          const Monitor& monitor) {
  std::vector<VertexId> all;
  for (const VertexId v : mesh.vertices()) all.push_back(v);
  Eigen::MatrixXd result = geodesic_distances(mesh, positions, all, method, monitor);
  make_symmetric(result);
  return result;
}

}  // namespace wilt
