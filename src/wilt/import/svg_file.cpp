#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/isolated.hpp"
#include "wilt/import/packing.hpp"
#include "wilt/import/svg_document.hpp"

namespace wilt::detail {

DrawnLeaf parse_svg_outline(std::string_view text, int nth) {
  return outline_of_drawing(svg::parse_elements(text), nth);
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
