#include "wilt/render/vein_orders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <utility>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"

namespace wilt {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;

constexpr int kHighestOrder = 255;  // a byte of a picture

struct Segment {
  Vec3 a, b;
  int order;
};

Box box_around(const Segment& segment, double reach) {
  const Vec3 low = segment.a.cwiseMin(segment.b).array() - reach;
  const Vec3 high = segment.a.cwiseMax(segment.b).array() + reach;
  return {Point(low.x(), low.y(), low.z()), Point(high.x(), high.y(), high.z())};
}

double squared_distance(const Segment& segment, const Vec3& p) {
  const Vec3 along = segment.b - segment.a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - segment.a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (segment.a + t * along - p).squaredNorm();
}

// The vein's points on the blade's faces at rest.
Points3 points_at_rest(const GlbMesh& blade, const GlbVein& vein) {
  Points3 points(vein.positions.rows(), 3);
  for (int i = 0; i < points.rows(); ++i) {
    const auto corners = blade.faces.row(vein.faces[std::size_t(i)]);
    points.row(i) = vein.barycentric(i, 0) * blade.frames.front().row(corners[0]) +
                    vein.barycentric(i, 1) * blade.frames.front().row(corners[1]) +
                    vein.barycentric(i, 2) * blade.frames.front().row(corners[2]);
  }
  return points;
}

}  // namespace

struct VeinOrders::Tree {
  bg::index::rtree<std::pair<Box, int>, bg::index::quadratic<16>> boxes;  // each as far as its vein reaches
  std::vector<Segment> segments;
};

VeinOrders::VeinOrders(const GlbFile& file, double width, double ratio)
    : tree_(std::make_unique<Tree>()), width_(width), ratio_(ratio) {
  WILT_CHECK(width > 0.0 && ratio > 0.0 && ratio <= 1.0, width, ratio);
  std::vector<std::pair<Box, int>> boxes;
  for (const GlbVein& vein : file.veins) {
    if (vein.order < 1 || vein.order > kHighestOrder)
      throw Error(ErrorCode::input, fmt::format("vein {} of the result has the order {}; labels have 1 to {}",
                                                &vein - file.veins.data(), vein.order, kHighestOrder));
    highest_ = std::max(highest_, vein.order);
    const Points3 points = points_at_rest(file.meshes.front(), vein);
    for (int i = 0; i + 1 < points.rows(); ++i) {
      tree_->segments.push_back({points.row(i).transpose(), points.row(i + 1).transpose(), vein.order});
      boxes.emplace_back(box_around(tree_->segments.back(), 0.5 * this->width(vein.order)),
                         static_cast<int>(boxes.size()));
    }
  }
  tree_->boxes = decltype(tree_->boxes)(boxes);
}

VeinOrders::~VeinOrders() = default;
VeinOrders::VeinOrders(VeinOrders&&) noexcept = default;

double VeinOrders::width(int order) const {
  return width_ * std::pow(ratio_, order - 1);
}

int VeinOrders::at(const Vec3& rest) const {
  int found = 0;
  const auto here = bg::index::intersects(Point(rest.x(), rest.y(), rest.z()));
  for (auto entry = tree_->boxes.qbegin(here); entry != tree_->boxes.qend(); ++entry) {
    const Segment& segment = tree_->segments[std::size_t(entry->second)];
    if (found > 0 && segment.order >= found) continue;
    const double reach = 0.5 * width(segment.order);
    if (squared_distance(segment, rest) <= reach * reach) found = segment.order;
  }
  return found;
}

}  // namespace wilt
