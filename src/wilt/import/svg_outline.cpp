#include <fmt/format.h>

#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/svg_choice.hpp"
#include "wilt/import/svg_shapes.hpp"

namespace wilt::detail {

DrawnLeaf outline_of_drawing(const svg::Elements& elements, int nth) {
  const svg::Drawing drawing = svg::drawing_of(elements);
  ChosenLeaf chosen = choose_leaf(drawing, nth);
  const auto flip = [](Points2& ring) { ring.col(1) *= -1.0; };
  flip(chosen.outline.margin);
  for (Points2& hole : chosen.outline.holes) flip(hole);
  DrawnLeaf drawn;
  drawn.outline = std::move(chosen.outline);
  if (chosen.stalk_foot) drawn.petiole = Vec2(chosen.stalk_foot->x(), -chosen.stalk_foot->y());
  drawn.mm_per_unit = drawing.mm_per_unit;
  drawn.y_down = true;
  drawn.notes = std::move(chosen.notes);
  drawn.notes.push_back(
      drawing.physical
          ? fmt::format("scale from the drawing's width and height: {:.4g} mm per unit", drawing.mm_per_unit)
          : "scale: 1/96 inch per unit, as the drawing names no physical size");
  return drawn;
}

}  // namespace wilt::detail
