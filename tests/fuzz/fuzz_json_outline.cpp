// An outline as JSON. Its numbers are finite; written again it is read as the same outline.
#include <nlohmann/json.hpp>

#include "fuzz/contract.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/leaf/petiole.hpp"

namespace {

using namespace wilt;
using nlohmann::json;

json ring_json(const Points2& ring) {
  json rows = json::array();
  for (int i = 0; i < ring.rows(); ++i) rows.push_back({ring(i, 0), ring(i, 1)});
  return rows;
}

std::string written(const DrawnLeaf& drawn) {
  json document = {{"outline", ring_json(drawn.outline.margin)}, {"mm_per_unit", drawn.mm_per_unit}};
  for (const Points2& hole : drawn.outline.holes) document["holes"].push_back(ring_json(hole));
  if (drawn.petiole) document["petiole"] = {drawn.petiole->x(), drawn.petiole->y()};
  return document.dump();
}

void check(const DrawnLeaf& drawn) {
  fuzz::require(drawn.outline.margin.rows() >= 3 && drawn.outline.margin.allFinite(),
                "the margin is a finite ring");
  for (const Points2& hole : drawn.outline.holes)
    fuzz::require(hole.rows() >= 3 && hole.allFinite(), "holes are finite rings");
  fuzz::require(drawn.mm_per_unit > 0.0, "the scale is positive");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto drawn = fuzz::unless_refused([&] { return parse_json_outline(fuzz::text_of(data, size)); });
  if (!drawn) return 0;
  check(*drawn);
  const DrawnLeaf again = parse_json_outline(written(*drawn));
  // Closing points go away once for every reading.
  if (again.outline.margin.rows() == drawn->outline.margin.rows())
    fuzz::require(again.outline.margin == drawn->outline.margin, "the same outline is read again");
  if (drawn->outline.margin.rows() > 200 || drawn->outline.holes.size() > 20) return 0;
  fuzz::unless_refused([&] {
    validate_outline(drawn->outline);
    const StalkCut cut = cut_stalk(drawn->outline);
    validate_outline(cut.blade);
    const int base = find_petiole(cut.blade.margin).index;
    fuzz::require(base >= 0 && base < cut.blade.margin.rows(), "the petiole is a point of the margin");
    return true;
  });
  return 0;
}
