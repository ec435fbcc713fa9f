// The points of a text file. They are finite, and the same when they are written and read again.
#include <fmt/format.h>

#include "fuzz/contract.hpp"
#include "wilt/import/scan_points.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wilt;
  std::vector<std::string> notes;
  const auto points =
      fuzz::unless_refused([&] { return detail::parse_points(fuzz::text_of(data, size), notes); });
  if (!points) return 0;
  fuzz::require(points->allFinite(), "points are finite");
  std::string text = "x y z\n";
  for (int i = 0; i < points->rows(); ++i)
    text += fmt::format("{} {} {}\n", (*points)(i, 0), (*points)(i, 1), (*points)(i, 2));
  const Points3 again = detail::parse_points(text, notes);
  fuzz::require(again.rows() == points->rows() && again == *points, "the same points are read again");
  return 0;
}
