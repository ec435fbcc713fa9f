// The rings of an outline, margin first, and questions about them. Inside the leaf room only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wilt/leaf/curves.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

/// The margin, then the holes.
std::vector<Polyline> rings_of(const Outline& outline);

/// "the margin" or "hole 2".
std::string ring_name(int ring);

struct Crossing {
  int ring1, index1;  ///< the segment from point `index1` of `ring1` to the next point
  int ring2, index2;
  Vec2 near;
};

/// Two segments of the rings that cross, touch or fold back onto each other, or nothing. O(n log n) for
/// segments of similar lengths.
std::optional<Crossing> find_crossing(const std::vector<Polyline>& rings);

}  // namespace wilt::detail
