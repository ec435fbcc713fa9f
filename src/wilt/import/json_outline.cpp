#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/import/drawn_leaf.hpp"

namespace wilt::detail {
namespace {

using nlohmann::json;

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::input, fmt::format("'{}': {}", file_, message));
  }

  double number(const json& value, const std::string& place) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(fmt::format("{} is {}; it must be a finite number", place, shown(value)));
    return value.get<double>();
  }

  Vec2 point(const json& value, const std::string& place) const {
    if (!value.is_array() || value.size() != 2)
      fail(fmt::format("{} is {}; it must be a point [x, y]", place, shown(value)));
    return {number(value[0], place + "[0]"), number(value[1], place + "[1]")};
  }

  Points2 ring(const json& value, const std::string& place) const {
    if (!value.is_array() || value.size() < 3)
      fail(fmt::format("{} is {}; it must be an array of three points or more", place, shown(value)));
    Points2 points(static_cast<int>(value.size()), 2);
    for (std::size_t i = 0; i < value.size(); ++i)
      points.row(static_cast<int>(i)) = point(value[i], fmt::format("{}[{}]", place, i)).transpose();
    // A ring that repeats its first point at the end is closed twice.
    const int last = static_cast<int>(points.rows()) - 1;
    if (last >= 3 && points.row(0) == points.row(last)) points.conservativeResize(last, 2);
    return points;
  }

 private:
  static std::string shown(const json& value) {
    const std::string text = value.dump();
    return text.size() > 40 ? fmt::format("{} of {} entries", value.type_name(), value.size()) : text;
  }

  std::string file_;
};

}  // namespace

DrawnLeaf read_json_outline(const std::filesystem::path& file) {
  const Reader reader(file.filename().string());
  std::ifstream in(file);
  json document;
  try {
    document = json::parse(in);
  } catch (const json::exception& error) {
    reader.fail(fmt::format("not JSON: {}", error.what()));
  }
  if (!document.is_object()) reader.fail("the document must be an object with the key \"outline\"");
  const std::vector<std::string> known{"outline", "holes", "petiole", "mm_per_unit"};
  for (const auto& [key, value] : document.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      reader.fail(fmt::format("unknown key \"{}\"{}; allowed are outline, holes, petiole, mm_per_unit", key,
                              did_you_mean(key, known)));
  }
  if (!document.contains("outline")) reader.fail("the key \"outline\" is missing");

  DrawnLeaf drawn;
  drawn.outline.margin = reader.ring(document["outline"], "outline");
  if (document.contains("holes")) {
    const json& holes = document["holes"];
    if (!holes.is_array()) reader.fail("holes must be an array of rings");
    for (std::size_t h = 0; h < holes.size(); ++h)
      drawn.outline.holes.push_back(reader.ring(holes[h], fmt::format("holes[{}]", h)));
  }
  if (document.contains("petiole")) drawn.petiole = reader.point(document["petiole"], "petiole");
  if (document.contains("mm_per_unit")) {
    drawn.mm_per_unit = reader.number(document["mm_per_unit"], "mm_per_unit");
    if (!(drawn.mm_per_unit > 0)) reader.fail("mm_per_unit must be above 0");
  }
  return drawn;
}

}  // namespace wilt::detail
