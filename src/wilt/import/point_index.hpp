// Nearest neighbours in space. Inside the import room only.
#pragma once

#include <memory>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::detail {

/// A k-d tree over points (#P x 3), which must outlive it unchanged. Building O(#P log #P); deterministic.
class PointIndex {
 public:
  explicit PointIndex(const Points3& points);
  ~PointIndex();
  PointIndex(const PointIndex&) = delete;
  PointIndex& operator=(const PointIndex&) = delete;

  /// The `count` nearest points (all, if there are fewer), the nearest first.
  std::vector<int> nearest(const Vec3& place, int count) const;

  /// The points within `radius`, in ascending order.
  std::vector<int> within(const Vec3& place, double radius) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace wilt::detail
