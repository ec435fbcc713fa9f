#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "wilt/leaf/petiole.hpp"

namespace wilt {
namespace {

Outline outline_of(const std::vector<Vec2>& points) {
  Outline outline;
  outline.margin.resize(static_cast<int>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    outline.margin.row(static_cast<int>(i)) = points[i].transpose();
  return outline;
}

// A disc of radius 1 about the origin, with a straight stalk of the given width along -y to y = -1 - length.
Outline disc_with_stalk(double width, double length, int points = 300) {
  std::vector<Vec2> ring;
  const double half = std::asin(width / 2);
  for (int i = 0; i <= points; ++i) {
    const double angle = -std::numbers::pi / 2 + half + (2 * std::numbers::pi - 2 * half) * i / points;
    ring.emplace_back(std::cos(angle), std::sin(angle));
  }
  if (length > 0) {
    ring.emplace_back(-width / 2, -1 - length);
    ring.emplace_back(width / 2, -1 - length);
  }
  return outline_of(ring);
}

// Oracle: the stalk's own width, direction and length; the cut lies within a width of the disc's edge.
TEST(CutStalk, FindsAStalkOfKnownWidthAndLength) {
  for (const double width : {0.04, 0.08, 0.12}) {
    const StalkCut cut = cut_stalk(disc_with_stalk(width, 0.9));
    ASSERT_TRUE(cut.found) << width;
    EXPECT_NEAR(cut.petiole.x(), 0.0, 0.02);
    EXPECT_NEAR(cut.petiole.y(), -1.0, width);
    const int last = static_cast<int>(cut.centreline.rows()) - 1;
    EXPECT_NEAR(cut.centreline(0, 1), cut.petiole.y(), 1e-12);
    EXPECT_NEAR(cut.centreline(last, 1), -1.9, width);
    EXPECT_NEAR(cut.half_widths[last / 2], width / 2, 0.02 * width + 0.002);
    for (int i = 0; i < cut.blade.margin.rows(); ++i) EXPECT_LE(cut.blade.margin.row(i).norm(), 1 + width);
  }
}

// Oracle: the drawing turned round (y down) or numbered from elsewhere is the same drawing.
TEST(CutStalk, DoesNotDependOnOrientationOrNumbering) {
  const Outline outline = disc_with_stalk(0.08, 0.9);
  Outline other = outline;
  other.margin = outline.margin.colwise().reverse().eval();
  const int n = static_cast<int>(other.margin.rows()), shift = 77;
  Points2 rotated(n, 2);
  for (int i = 0; i < n; ++i) rotated.row(i) = other.margin.row((i + shift) % n);
  other.margin = rotated;
  const StalkCut a = cut_stalk(outline), b = cut_stalk(other);
  ASSERT_TRUE(a.found && b.found);
  EXPECT_LT((a.petiole - b.petiole).norm(), 0.02);  // two samples of 0.005 sqrt(area) = 0.009
}

// Oracle: there is no stalk: a disc, an acuminate tip that narrows steadily, a star of pointed lobes, a
// narrow sinus (a stalk's negative).
TEST(CutStalk, LeavesShapesWithoutStalkAlone) {
  EXPECT_FALSE(cut_stalk(disc_with_stalk(0.1, 0.0)).found);
  std::vector<Vec2> lens;
  for (int i = 0; i <= 100; ++i) lens.emplace_back(0.12 * std::sin(std::numbers::pi * i / 100), 0.02 * i);
  for (int i = 99; i > 0; --i) lens.emplace_back(-0.12 * std::sin(std::numbers::pi * i / 100), 0.02 * i);
  EXPECT_FALSE(cut_stalk(outline_of(lens)).found);
  std::vector<Vec2> star;
  for (int i = 0; i < 14; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 0.45, angle = std::numbers::pi * i / 7;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  EXPECT_FALSE(cut_stalk(outline_of(star)).found);
  EXPECT_FALSE(
      cut_stalk(outline_of(
                    {{-1, -1}, {-0.03, -1}, {-0.03, 0.2}, {0.03, 0.2}, {0.03, -1}, {1, -1}, {1, 1}, {-1, 1}}))
          .found);
}

}  // namespace
}  // namespace wilt
