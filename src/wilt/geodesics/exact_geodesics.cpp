#include "wilt/geodesics/exact_geodesics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/geodesics/window_propagation.hpp"

namespace wilt {
namespace {

using detail::Arrival;
using detail::HalfedgeFrame;
using detail::Unfolding;
using detail::Window;
using detail::WindowPropagation;

// A point so close to an edge's end, in edge lengths, is put on the vertex.
constexpr double kSnap = 1e-11;

class Backtrace {
 public:
  Backtrace(const SurfaceMesh& mesh, const Unfolding& unfolding, const WindowPropagation& sweep)
      : mesh_(mesh), unfolding_(unfolding), sweep_(sweep) {}

  /// The points from `target` back to the source.
  std::vector<SurfacePoint> run(VertexId target, VertexId source) {
    add_vertex(target);
    for (VertexId v = target; v != source;) {
      const Arrival& arrival = sweep_.arrival(v);
      v = arrival.edge.valid() ? mesh_.from(arrival.edge) : follow_windows(arrival.window);
      add_vertex(v);
    }
    return std::move(points_);
  }

 private:
  // Walks from the apex beyond the window back to the vertex where its paths start; returns that vertex.
  VertexId follow_windows(int index) {
    const Window* window = &sweep_.history()[index];
    Vec2 point = unfolding_.frame(window->halfedge).apex;
    while (true) {
      const double x = std::clamp(detail::meet_axis(window->source, point), window->begin, window->end);
      add_crossing(window->halfedge, x / unfolding_.length(window->halfedge));
      if (window->parent < 0) return mesh_.to(mesh_.next(mesh_.twin(window->halfedge)));
      const Window& parent = sweep_.history()[window->parent];
      const HalfedgeFrame& frame = unfolding_.frame(parent.halfedge);
      point = window->from_start ? Vec2(x * frame.left) : Vec2(frame.apex + x * frame.right);
      window = &parent;
    }
  }

  void add_vertex(VertexId v) {
    if (v == last_) return;
    points_.push_back(surface_point(mesh_, v));
    last_ = v;
  }

  void add_crossing(HalfedgeId h, double t) {
    if (t < kSnap) return add_vertex(mesh_.from(h));
    if (t > 1.0 - kSnap) return add_vertex(mesh_.to(h));
    points_.push_back(surface_point(mesh_, h, t));
    last_ = VertexId();
  }

  const SurfaceMesh& mesh_;
  const Unfolding& unfolding_;
  const WindowPropagation& sweep_;
  std::vector<SurfacePoint> points_;
  VertexId last_;  // the vertex on which the last point lies, if any
};

}  // namespace

ExactGeodesics::ExactGeodesics(const SurfaceMesh& mesh, const Points3& positions)
    : mesh_(mesh), positions_(positions), unfolding_(std::make_shared<const Unfolding>(mesh, positions)) {}

Eigen::VectorXd ExactGeodesics::distances(VertexId source) const {
  detail::check_vertex(mesh_, source, "the source");
  WindowPropagation sweep(mesh_, *unfolding_, source, false);
  sweep.run();
  return Eigen::Map<const Eigen::VectorXd>(sweep.distances().data(), mesh_.num_vertices());
}

std::vector<SurfacePath> ExactGeodesics::paths(VertexId source, const std::vector<VertexId>& targets,
                                               std::span<const char> within) const {
  detail::check_vertex(mesh_, source, "the source");
  for (const VertexId v : targets) detail::check_vertex(mesh_, v, "the target");
  std::vector<SurfacePath> result;
  if (targets.empty()) return result;
  WindowPropagation sweep(mesh_, *unfolding_, source, true, within);
  sweep.run(targets);
  for (const VertexId target : targets) {
    SurfacePath& path = result.emplace_back();
    if (!std::isfinite(sweep.distances()[target])) {
      if (!within.empty()) continue;
      throw Error(ErrorCode::input,
                  fmt::format("no path leads from vertex {} to vertex {}: they lie on separate parts of "
                              "the surface; join the parts or choose one",
                              int(source), int(target)));
    }
    path.points = Backtrace(mesh_, *unfolding_, sweep).run(target, source);
    std::reverse(path.points.begin(), path.points.end());
    for (std::size_t i = 1; i < path.points.size(); ++i)
      path.length +=
          (position(mesh_, positions_, path.points[i]) - position(mesh_, positions_, path.points[i - 1]))
              .norm();
  }
  return result;
}

}  // namespace wilt
