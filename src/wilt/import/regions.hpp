// Filled areas of the plane: fill rules, unions, overlaps. Inside the import room only.
#pragma once

#include <vector>

#include "wilt/import/svg_values.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

/// Boolean operations on an integer grid over a box (Boost.Polygon): points move by up to 2^-25 of its size.
class RegionGrid {
 public:
  /// The box must hold every point that is passed in later.
  RegionGrid(const Vec2& low, const Vec2& high);

  /// The connected areas that rings fill, largest first; margins counter-clockwise, no ring crosses itself.
  /// Slivers below 1e-9 of the box are left out.
  std::vector<Outline> fill(const std::vector<svg::Ring>& rings, bool even_odd) const;

  /// The areas covered by either, largest first.
  std::vector<Outline> unite(const Outline& a, const Outline& b) const;

  /// The area covered by both, in the box's unit squared.
  double overlap(const Outline& a, const Outline& b) const;

 private:
  Vec2 centre_;
  double scale_;
};

/// The area inside a margin without its holes.
double area_of(const Outline& outline);

}  // namespace wilt::detail
