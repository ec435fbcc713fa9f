#include "wilt/import/point_index.hpp"

#include <algorithm>
#include <nanoflann.hpp>

namespace wilt::detail {

struct PointIndex::Tree {
  struct Source {
    const Points3& points;
    std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.rows()); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis));
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Source>, Source, 3, int>;

  explicit Tree(const Points3& points) : source{points}, index(3, source) {}
  Source source;
  Index index;
};

PointIndex::PointIndex(const Points3& points) : tree_(std::make_unique<Tree>(points)) {}
PointIndex::~PointIndex() = default;

std::vector<int> PointIndex::nearest(const Vec3& place, int count) const {
  std::vector<int> found(static_cast<std::size_t>(count));
  std::vector<double> squared(static_cast<std::size_t>(count));
  found.resize(tree_->index.knnSearch(place.data(), found.size(), found.data(), squared.data()));
  return found;
}

std::vector<int> PointIndex::within(const Vec3& place, double radius) const {
  std::vector<std::pair<int, double>> matches;
  tree_->index.radiusSearch(place.data(), radius * radius, matches, nanoflann::SearchParams(0, 0.0F, false));
  std::vector<int> found;
  for (const auto& match : matches) found.push_back(match.first);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace wilt::detail
