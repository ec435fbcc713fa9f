#include <utility>

#include "wilt/geodesics/trace.hpp"

namespace wilt {
namespace {

// A way that grows longer than this, in straight distances, goes round something.
constexpr double kLongest = 3.0;

class Walk {
 public:
  Walk(const SurfaceMesh& mesh, const Points3& positions, const SurfacePoint& start)
      : mesh_(mesh), positions_(positions) {
    path_.points.push_back(start);
  }

  /// Appends the way to `target`; nothing when it leaves the surface.
  bool go(const SurfacePoint& target) {
    const SurfacePath before = path_;
    const Vec3 aim = at(target);
    const double most = path_.length + kLongest * (aim - at(path_.points.back())).norm();
    for (int crossed = 0; !common_face(mesh_, path_.points.back(), target).valid(); ++crossed) {
      const Vec3 ahead = aim - at(path_.points.back());
      const SurfacePath step =
          trace_straight(mesh_, positions_, path_.points.back(), ahead, kLongest * ahead.norm(), {},
                         [](const SurfacePoint&) { return true; });
      if (step.points.size() < 2 || path_.length > most || crossed > mesh_.num_faces()) {
        path_ = before;
        return false;
      }
      append(step.points.back());
    }
    if ((aim - at(path_.points.back())).norm() > 0.0) append(target);
    return true;
  }

  SurfacePath take() { return std::move(path_); }

 private:
  Vec3 at(const SurfacePoint& point) const { return position(mesh_, positions_, point); }
  void append(const SurfacePoint& point) {
    path_.length += (at(point) - at(path_.points.back())).norm();
    path_.points.push_back(point);
  }

  const SurfaceMesh& mesh_;
  const Points3& positions_;
  SurfacePath path_;
};

}  // namespace

DrawnPath trace_through(const SurfaceMesh& mesh, const Points3& positions,
                        const std::vector<SurfacePoint>& points) {
  Walk walk(mesh, positions, points.front());
  int reached = 1;
  while (reached < static_cast<int>(points.size()) && walk.go(points[static_cast<std::size_t>(reached)]))
    ++reached;
  return {walk.take(), reached};
}

}  // namespace wilt
