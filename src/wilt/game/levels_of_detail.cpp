#include "wilt/game/levels_of_detail.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cstdint>
#include <limits>
#include <utility>

#include "wilt/core/parallel.hpp"
#include "wilt/geodesics/nearest_point.hpp"

namespace wilt {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Floats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

Point as_point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

// The largest distance of any of the points to the triangles.
double deviation(const Points3& points, const Faces& faces) {
  using Entry = std::pair<Box, int>;
  std::vector<Entry> boxes;
  for (int f = 0; f < faces.rows(); ++f) {
    Box box = bg::make_inverse<Box>();
    for (int c = 0; c < 3; ++c) bg::expand(box, as_point(points.row(faces(f, c))));
    boxes.emplace_back(box, f);
  }
  const bg::index::rtree<Entry, bg::index::quadratic<16>> tree(boxes);
  double largest = 0.0;
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i);
    double nearest = std::numeric_limits<double>::infinity();
    const auto by_distance = bg::index::nearest(as_point(p), static_cast<unsigned>(boxes.size()));
    for (auto entry = tree.qbegin(by_distance); entry != tree.qend(); ++entry) {
      if (bg::distance(as_point(p), entry->first) >= nearest) break;
      nearest = std::min(nearest, nearest_point(faces.row(entry->second), points, p).distance);
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

Faces simplified(const Faces& faces, const Floats& positions, Eigen::Index triangles) {
  const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor> indices =
      faces.cast<std::uint32_t>();
  std::vector<std::uint32_t> fewer(static_cast<std::size_t>(indices.size()));
  constexpr float kAnyError = std::numeric_limits<float>::max();
  fewer.resize(meshopt_simplify(fewer.data(), indices.data(), fewer.size(), positions.data(),
                                static_cast<std::size_t>(positions.rows()), 3 * sizeof(float),
                                static_cast<std::size_t>(3 * triangles), kAnyError,
                                meshopt_SimplifyLockBorder, nullptr));
  return Eigen::Map<const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>>(
             fewer.data(), static_cast<Eigen::Index>(fewer.size() / 3), 3)
      .cast<int>();
}

}  // namespace

std::vector<DetailLevel> levels_of_detail(const Moving& mesh, int frames, int count) {
  std::vector<Points3> positions(static_cast<std::size_t>(frames));
  parallel_for(frames, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) positions[static_cast<std::size_t>(k)] = mesh.shape(k).positions;
  });
  const Floats wrinkled = positions.back().cast<float>();
  std::vector<DetailLevel> levels(static_cast<std::size_t>(count));
  for (int level = 0; level < count; ++level) {
    DetailLevel& made = levels[static_cast<std::size_t>(level)];
    made.faces =
        simplified(mesh.faces, wrinkled, std::max<Eigen::Index>(mesh.faces.rows() >> (level + 1), 1));
    Eigen::VectorXd of_frame(frames);
    parallel_for(frames, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k)
        of_frame[k] = deviation(positions[static_cast<std::size_t>(k)], made.faces);
    });
    made.deviation = of_frame.maxCoeff();
  }
  return levels;
}

}  // namespace wilt
