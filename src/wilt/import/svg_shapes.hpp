// The filled shapes of a drawing. Inside the import room only.
#pragma once

#include <vector>

#include "wilt/import/svg_element.hpp"
#include "wilt/import/svg_values.hpp"

namespace wilt::svg {

struct Shape {
  std::vector<Ring> rings;  ///< in the drawing's units, y down
  bool even_odd = false;
  Paint paint;           ///< never "none"
  double opacity = 1.0;  ///< with that of the groups around it
  bool blurred = false;  ///< by a filter of its own or of a group
};

struct Drawing {
  std::vector<Shape> shapes;  ///< in the order of painting
  double mm_per_unit = 25.4 / 96.0;
  bool physical = false;  ///< whether width, height and viewBox gave mm_per_unit
};

/// Paths, polygons, rectangles, circles and ellipses with a fill, transforms applied, curves flattened to
/// 1e-4 of the drawing's size. Fills come from attributes, style, style sheets (by element, class and id)
/// and groups. Throws Error{input} when its root is no SVG.
Drawing drawing_of(const Elements& elements);

}  // namespace wilt::svg
