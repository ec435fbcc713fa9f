// A drawing, up to the outline of its leaf. The shapes' rings are rings; so are those of the leaf, which has
// an area.
#include "fuzz/contract.hpp"
#include "wilt/import/svg_choice.hpp"
#include "wilt/import/svg_document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  const auto drawing =
      fuzz::unless_refused([&] { return svg::drawing_of(svg::parse_elements(fuzz::text_of(data, size))); });
  if (!drawing) return 0;
  fuzz::require(drawing->mm_per_unit > 0.0, "the scale is positive");
  std::size_t points = 0;
  for (const svg::Shape& shape : drawing->shapes) {
    fuzz::require(!shape.rings.empty(), "a shape has rings");
    for (const svg::Ring& ring : shape.rings) {
      fuzz::require(ring.size() >= 3, "a ring has three points or more");
      for (const Vec2& point : ring) fuzz::require(point.allFinite(), "points are finite");
      points += ring.size();
    }
  }
  if (points > 3000) return 0;
  const auto leaf = fuzz::unless_refused([&] { return detail::choose_leaf(*drawing, 1); });
  if (!leaf) return 0;
  fuzz::require(leaf->outline.margin.rows() >= 3 && leaf->outline.margin.allFinite(),
                "the margin is a finite ring");
  return 0;
}
