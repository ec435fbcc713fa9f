// Springs of eight leaves of one topology, side by side (internal).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "wilt/mechanics/spring_network.hpp"

namespace wilt::detail {

/// One vertex of eight leaves: neighbours are loaded as they lie, with nothing to gather.
struct LeafLanes {
  static constexpr int kLeaves = simd::kLanes;
  using Stored = Point8;
  static constexpr int kStoredPerGroup = 1;

  template <class Number>
  using Leaves = std::array<Number*, kLeaves>;

  static int leaf(int lane) { return lane; }
  static int index(int group, int) { return group; }
  WILT_INLINE static Double8 reduce(Double8 v) { return v; }

  WILT_INLINE static Point8 own(const Point8* points, int group) { return points[group]; }
  WILT_INLINE static Point8 neighbours(const Point8* points, const int* rows, int slot) {
    return points[rows[slot]];
  }
  WILT_INLINE static void store(Point8* points, int group, const Point8& p) { points[group] = p; }
  WILT_INLINE static Point8 load(const Leaves<const double>& from, const int* vertices, int group) {
    const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(vertices[group]);
    return simd::transpose([&](int k) __attribute__((always_inline)) {
      return Double4{from[k][at], from[k][at + 1], from[k][at + 2], 0.0};
    });
  }
  WILT_INLINE static void store(const Leaves<double>& to, const int* vertices, int group, int,
                                const Point8& p) {  // not where `to` is null
    std::array<Point4, kLeaves> points;
    simd::store_points(points.data(), p);
    for (int l = 0; l < kLeaves; ++l) {
      if (to[l] == nullptr) continue;
      double* out = to[l] + 3 * static_cast<std::ptrdiff_t>(vertices[group]);
      for (int k = 0; k < 3; ++k) out[k] = points[l].xyz[k];
    }
  }
};

/// The laws of eight leaves on one set of edges. A group is a vertex, a slot one of its neighbours.
class LeafSprings {
 public:
  using Lanes = LeafLanes;

  explicit LeafSprings(const EdgeRows& rows);

  /// Takes over the parts of the leaves' laws that it does not have yet.
  void set_laws(const std::array<const EdgeLaw*, LeafLanes::kLeaves>& laws);

  int group_count() const { return static_cast<int>(vertices_.size()); }
  int vertex_count() const { return group_count(); }
  const int* slot_begin() const { return slot_begin_.data(); }
  const int* neighbours() const { return neighbours_.data(); }
  const int* vertices() const { return vertices_.data(); }
  const Number8* stretch() const { return stretch_.data(); }
  const Number8* push() const { return push_.data(); }
  const Number8* damping() const { return damping_.data(); }
  bool damped() const { return damped_; }
  int stiffness_revision() const { return stiffness_revision_; }

 private:
  void set_part(const std::array<const EdgeLaw*, LeafLanes::kLeaves>& laws, EdgeLaw::Part part);

  std::vector<int> slot_begin_, neighbours_, vertices_, ends_;
  std::vector<Number8> stretch_, push_, damping_;
  std::array<std::array<int, 2>, LeafLanes::kLeaves> revisions_;
  bool damped_ = false;
  int stiffness_revision_ = 0;
};

}  // namespace wilt::detail
