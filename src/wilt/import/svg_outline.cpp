#include <fmt/format.h>

#include "wilt/core/error.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/isolated.hpp"
#include "wilt/import/packing.hpp"
#include "wilt/import/svg_choice.hpp"
#include "wilt/import/svg_shapes.hpp"

namespace wilt::detail {

DrawnLeaf parse_svg_outline(std::string_view text, int nth) {
  const svg::Drawing drawing = svg::parse_drawing(text);
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

DrawnLeaf read_svg_outline(std::string_view text, int nth, const Monitor& monitor) {
  const auto parse = [&] {
    const DrawnLeaf drawn = parse_svg_outline(text, nth);
    Packer packer;
    packer.matrix(drawn.outline.margin);
    packer.value(drawn.outline.holes.size());
    for (const Points2& hole : drawn.outline.holes) packer.matrix(hole);
    packer.value(drawn.petiole.has_value());
    const Vec2 petiole = drawn.petiole.value_or(Vec2::Zero());
    packer.value(petiole.x());
    packer.value(petiole.y());
    packer.value(drawn.mm_per_unit);
    packer.texts(drawn.notes);
    return packer.take();
  };
  const std::string packed = run_isolated("the reader of drawings", parse, monitor);
  Unpacker unpacker(packed);
  DrawnLeaf drawn;
  drawn.outline.margin = unpacker.matrix<Points2>();
  drawn.outline.holes.resize(unpacker.value<std::size_t>());
  for (Points2& hole : drawn.outline.holes) hole = unpacker.matrix<Points2>();
  const bool has_petiole = unpacker.value<bool>();
  const double x = unpacker.value<double>(), y = unpacker.value<double>();
  if (has_petiole) drawn.petiole = Vec2(x, y);
  drawn.mm_per_unit = unpacker.value<double>();
  drawn.y_down = true;
  drawn.notes = unpacker.texts();
  return drawn;
}

}  // namespace wilt::detail
