// Which vein a place of a leaf belongs to.
#pragma once

#include <memory>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/output/gltf.hpp"

namespace wilt {

/// The veins of a result as bands of a given width on the leaf at rest, so that they stay on the blade as it
/// withers: a place is in a vein when it is no farther than half its width from the vein's line.
class VeinOrders {
 public:
  /// A vein of order n (>= 1) is width * ratio^(n - 1) wide; `width` > 0 in the units of the file, `ratio` in
  /// (0, 1]. Throws Error{input} for an order beyond 255. O(#P log #P) for veins of #P points.
  VeinOrders(const GlbFile& file, double width, double ratio);
  ~VeinOrders();
  VeinOrders(VeinOrders&&) noexcept;

  double width(int order) const;  ///< in the units of the file
  int highest() const { return highest_; }

  /// The order of the vein at `rest`, a point of the leaf at rest (units of the file); the lowest of several,
  /// 0 beside all veins. O(log #P) and the segments near by.
  int at(const Vec3& rest) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  double width_, ratio_;
  int highest_ = 0;
};

}  // namespace wilt
