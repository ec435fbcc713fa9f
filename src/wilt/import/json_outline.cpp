#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/core/printable.hpp"
#include "wilt/import/leaf_in_memory.hpp"

namespace wilt {
namespace {

using nlohmann::json;

constexpr int kDeepest = 16;  // levels of arrays and objects

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::input, message);
}

// A wrong value as a message shows it.
std::string shown(const json& value) {
  const std::string text = value.dump();
  return text.size() > 40 ? fmt::format("{} of {} entries", value.type_name(), value.size()) : text;
}

double number(const json& value, const std::string& place) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    refuse(fmt::format("{} is {}; it must be a finite number", place, shown(value)));
  return value.get<double>();
}

Vec2 point(const json& value, const std::string& place) {
  if (!value.is_array() || value.size() != 2)
    refuse(fmt::format("{} is {}; it must be a point [x, y]", place, shown(value)));
  return {number(value[0], place + "[0]"), number(value[1], place + "[1]")};
}

Points2 ring(const json& value, const std::string& place) {
  if (!value.is_array() || value.size() < 3)
    refuse(fmt::format("{} is {}; it must be an array of three points or more", place, shown(value)));
  Points2 points(static_cast<int>(value.size()), 2);
  for (std::size_t i = 0; i < value.size(); ++i)
    points.row(static_cast<int>(i)) = point(value[i], fmt::format("{}[{}]", place, i)).transpose();
  // A ring that repeats its first point at the end is closed twice.
  const int last = static_cast<int>(points.rows()) - 1;
  if (last >= 3 && points.row(0) == points.row(last)) points.conservativeResize(last, 2);
  return points;
}

// An outline needs 4 levels; a document of very many would exhaust the stack where it is shown.
json parsed(std::string_view text) {
  try {
    return json::parse(text, [](int depth, json::parse_event_t, const json&) {
      if (depth > kDeepest) refuse(fmt::format("nested deeper than {} levels", kDeepest));
      return true;
    });
  } catch (const json::exception& error) {
    refuse(fmt::format("not JSON: {}", untagged(error.what())));
  }
}

}  // namespace

DrawnLeaf parse_json_outline(std::string_view text) {
  const json document = parsed(text);
  if (!document.is_object()) refuse("the document must be an object with the key \"outline\"");
  const std::vector<std::string> known{"outline", "holes", "petiole", "mm_per_unit"};
  for (const auto& [key, value] : document.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse(fmt::format("unknown key \"{}\"{}; allowed are outline, holes, petiole, mm_per_unit", key,
                         did_you_mean(key, known)));
  }
  if (!document.contains("outline")) refuse("the key \"outline\" is missing");

  DrawnLeaf drawn;
  drawn.outline.margin = ring(document["outline"], "outline");
  if (document.contains("holes")) {
    const json& holes = document["holes"];
    if (!holes.is_array()) refuse("holes must be an array of rings");
    for (std::size_t h = 0; h < holes.size(); ++h)
      drawn.outline.holes.push_back(ring(holes[h], fmt::format("holes[{}]", h)));
  }
  if (document.contains("petiole")) drawn.petiole = point(document["petiole"], "petiole");
  if (document.contains("mm_per_unit")) {
    drawn.mm_per_unit = number(document["mm_per_unit"], "mm_per_unit");
    if (!(drawn.mm_per_unit > 0)) refuse("mm_per_unit must be above 0");
  }
  return drawn;
}

}  // namespace wilt
