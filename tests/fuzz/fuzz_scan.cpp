// The points of a scan, from cleaning to a leaf of 200 vertices: 20 x 20 points, 8 units apart, that the
// bytes move.
//
// Bytes: options (bits: 1 y is up, 2 a unit is given, 4 a petiole is given); one for each of the points, two
// bits each for x, y and z and two for how far (the highest bits; 3 leaves the point out); then three for
// every further point.
#include "fuzz/leaf_checks.hpp"
#include "wilt/import/scan_leaf.hpp"

namespace {

using namespace wilt;

constexpr int kSide = 20;
constexpr std::size_t kMostFurther = 300;

std::vector<Vec3> read_points(fuzz::Bytes& bytes) {
  std::vector<Vec3> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int moved = bytes.byte(), far = moved >> 6;
    const Vec3 at(8.0 * (i % kSide), 8.0 * (i / kSide), 0.0);
    if (far < 3) points.push_back(at + (1 << 2 * far) * Vec3(moved & 3, moved >> 2 & 3, moved >> 4 & 3));
  }
  while (bytes.left() >= 3 && points.size() < kSide * kSide + kMostFurther)
    points.push_back(Vec3(2 * bytes.signed_byte(), 2 * bytes.signed_byte(), 2 * bytes.signed_byte()));
  return points;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int flags = bytes.byte();
  ReadOptions options;
  options.vertices = 200;
  if (flags & 2) options.mm_per_unit = 1e-9 * (1 + bytes.byte());
  if (flags & 4) options.petiole = Vec2(bytes.signed_byte(), bytes.signed_byte());
  const std::vector<Vec3> points = read_points(bytes);
  detail::Scan scan;
  scan.y_up = flags & 1;
  scan.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    scan.points.row(i) = points[static_cast<std::size_t>(i)].transpose();
  fuzz::check_refused_or_leaf([&] { return detail::leaf_from_scan(scan, "leaf", options, {}); });
  return 0;
}
