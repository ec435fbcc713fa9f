#include <fmt/format.h>

#include <iterator>

#include "wilt/core/version.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/vein_lines.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {

std::string veins_obj(const Leaf& leaf, const Venation& venation) {
  std::string text = fmt::format("# wilt {}\n# units: {}, up: Y\n", version(), unit_name(leaf.placement));
  const auto out = std::back_inserter(text);
  int first = 1, number = 0;
  for (const RestVein& line : vein_lines(leaf, venation)) {
    fmt::format_to(out, "o {}_{}\n", line.order == 1 ? "primary" : "secondary", ++number);
    const Points3 points = file_points(leaf.placement, line.positions);
    for (int i = 0; i < points.rows(); ++i)
      fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", points(i, 0), points(i, 1), points(i, 2));
    text += 'l';
    for (int i = 0; i < points.rows(); ++i) fmt::format_to(out, " {}", first + i);
    text += '\n';
    first += static_cast<int>(points.rows());
  }
  return text;
}

}  // namespace wilt
