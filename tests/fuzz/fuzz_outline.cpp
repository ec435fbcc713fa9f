// An outline, from its rings to a leaf of 200 vertices, whatever file it came from.
//
// Bytes: options (bits: 1 a petiole is given, 2 a scale of 1e-9, 4 a scale of 1e9), the number of rings and
// of points in each (up to 64 in all); then two bytes for every point.
#include "fuzz/leaf_checks.hpp"
#include "wilt/import/drawn_leaf.hpp"

namespace {

using namespace wilt;

Points2 ring(fuzz::Bytes& bytes, int points, double scale) {
  Points2 ring(points, 2);
  for (int i = 0; i < points; ++i) ring.row(i) << scale * bytes.signed_byte(), scale * bytes.signed_byte();
  return ring;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int flags = bytes.byte();
  const int holes = bytes.byte() % 4;
  const double scale = (flags & 2 ? 1e-9 : 1.0) * (flags & 4 ? 1e9 : 1.0);
  DrawnLeaf drawn;
  drawn.outline.margin = ring(bytes, bytes.byte() % 48, scale);
  for (int h = 0; h < holes; ++h) drawn.outline.holes.push_back(ring(bytes, bytes.byte() % 8, scale));
  if (flags & 1) drawn.petiole = scale * Vec2(bytes.signed_byte(), bytes.signed_byte());
  ReadOptions options;
  options.vertices = 200;
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_outline(drawn, "leaf", options, {}); });
  return 0;
}
