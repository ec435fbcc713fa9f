// Real scans made by others (WILT_SHARED): soybean and sugar beet, units of a millimetre.
#include <gtest/gtest.h>

#include <cstdlib>

#include "import/files.hpp"
#include "import/scan_files.hpp"
#include "wilt/core/file.hpp"
#include "wilt/import/point_index.hpp"
#include "wilt/import/scan_points.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

std::filesystem::path shared_scan(const std::string& name) {
  const char* folder = std::getenv("WILT_SHARED");
  const std::filesystem::path root = folder != nullptr ? std::filesystem::path(folder)
                                                       : std::filesystem::path(WILT_SOURCE_DIR) / "../shared";
  return root / "data" / "leaf_scans_3d" / name;
}

struct Expected {
  const char* file;
  double length_mm, area_mm2;
  Vec3 petiole;   // read off a plot of the points; for the soybean nobody can tell
  double within;  // of it
  const char* note;
};

class SharedScan : public ::testing::TestWithParam<Expected> {};

// Oracle: the points themselves: the surface lies among them (median distance below a spacing of about 0.5)
// and covers them (95 % of those that have neighbours lie within 1.5 of it); length, area and petiole as
// plots show.
TEST_P(SharedScan, GivesALeafAmongItsPoints) {
  const std::filesystem::path file = shared_scan(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared scans here; set WILT_SHARED";
  const Leaf leaf = read_leaf(file);
  const Points3 vertices = test::in_file(leaf);
  std::vector<std::string> notes;
  const Points3 points = detail::parse_points(read_file(file.string()), notes);
  const detail::PointIndex index(points), surface(vertices);
  int near = 0, covered = 0, crowded = 0;
  for (int i = 0; i < vertices.rows(); ++i)
    near += (points.row(index.nearest(vertices.row(i).transpose(), 1)[0]) - vertices.row(i)).norm() < 0.6;
  for (int i = 0; i < points.rows(); ++i) {
    if (index.within(points.row(i).transpose(), 1.5).size() < 12) continue;
    ++crowded;
    covered += (vertices.row(surface.nearest(points.row(i).transpose(), 1)[0]) - points.row(i)).norm() < 1.5;
  }
  EXPECT_GT(near, 0.5 * vertices.rows());
  EXPECT_GT(covered, 0.95 * crowded) << test::notes_of(leaf);
  EXPECT_NEAR(1e3 * leaf_length(leaf), GetParam().length_mm, 0.06 * GetParam().length_mm);
  EXPECT_NEAR(1e6 * surface_area(leaf.mesh, leaf.positions), GetParam().area_mm2, 0.08 * GetParam().area_mm2);
  EXPECT_LT((vertices.row(leaf.petiole).transpose() - GetParam().petiole).norm(), GetParam().within);
  EXPECT_TRUE(test::has_note(leaf, GetParam().note)) << test::notes_of(leaf);
  EXPECT_GT(smallest_angle(leaf.mesh, leaf.positions), 20.0 * 3.14159265 / 180);
}

INSTANTIATE_TEST_SUITE_P(
    Leaves, SharedScan,
    ::testing::Values(
        Expected{"soybean_11_20190508T043118_pot1_15.txt", 41.4, 950, {-21, -20, 124}, 100, "give --petiole"},
        Expected{
            "sugarbeet_f00012_20170829T010129_pot1_1.txt", 60.7, 460, {-4, 2, 33}, 6, "a trail of points"},
        Expected{"sugarbeet_f00012_20170830T140748_pot2_3.txt",
                 37.8,
                 815,
                 {-13, -2, 61},
                 3,
                 "a stalk was cut off"}));

// Oracle: slices of the points, looked at: leaflets that touch lie over each other at one end.
TEST(SharedScanOfTouchingLeaflets, IsRefused) {
  const std::filesystem::path file = shared_scan("soybean_11_20190508T043118_pot1_1.txt");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared scans here; set WILT_SHARED";
  try {
    read_leaf(file);
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("lies over itself"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wilt
