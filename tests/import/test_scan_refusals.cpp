// Scans that cannot be used: the message must say what, where, and what would do.
#include <gtest/gtest.h>

#include <numbers>

#include "import/files.hpp"
#include "import/scan_files.hpp"

namespace wilt {
namespace {

using test::RolledBlade;

class ScanRefusals : public test::Files {
 protected:
  void expect_refusal(const std::string& content, const std::string& words) const {
    const std::string message = refusal(write("scan.xyz", content));
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
};

std::string leaf_lines() {
  return test::lines(RolledBlade("poplar", 60.0).scan(2000, 0.3));
}

TEST_F(ScanRefusals, NameTheLineThatCannotBeRead) {
  expect_refusal(leaf_lines() + "1 2\n", "line 2001: 2 columns; a point needs x, y and z in 3 columns");
  expect_refusal(leaf_lines() + "1 2 3 4\n", "line 2001: 4 columns where the first point has 3");
  expect_refusal(leaf_lines() + "1 2 three\n", "line 2001: 'three' is no number");
  expect_refusal("a b c\n" + leaf_lines(), "line 1: 'a' is no number");
  expect_refusal("1,5;2,5;3,5\n", "line 1: both ; and , stand in it");
  expect_refusal(std::string("\x89PNG\0\r\n", 7), "it is no text file");
}

TEST_F(ScanRefusals, SayHowManyPointsAreNeeded) {
  expect_refusal("", "it is empty");
  expect_refusal("\n", "0 points are too few; a scan of a leaf needs 300");
  expect_refusal("# nothing\n\n", "0 points are too few");
  expect_refusal("0 0 0\n1 0 0\n0 1 0\n", "3 points are too few");
  std::string repeated, line;
  for (int i = 0; i < 1000; ++i) {
    repeated += fmt::format("{} 0 0\n", i % 7);
    line += fmt::format("{} {} 0.5\n", i, 2 * i);
  }
  expect_refusal(repeated, "7 points are too few");
  expect_refusal(line, "the points lie on a line");
}

TEST_F(ScanRefusals, LeaveOutPointsThatAreNoNumbers) {
  const Leaf leaf = read_leaf(write("leaf.xyz", "2001\n// x y z\n" + leaf_lines() + "nan nan nan\n"));
  EXPECT_TRUE(test::has_note(leaf, "1 points without numbers")) << test::notes_of(leaf);
}

TEST_F(ScanRefusals, GiveTheFiguresOfTooMuchNoise) {
  const std::vector<Vec3> points = RolledBlade("poplar", 60.0).scan(6000, 5.0);
  const std::string message = refusal(write("noisy.xyz", test::lines(points)));
  EXPECT_NE(message.find("too noisy"), std::string::npos) << message;
}

std::string sphere() {
  Random random(3, "sphere");
  std::string text;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = test::normal_point(random);
    const Vec3 q = 50.0 * p.normalized();
    text += fmt::format("{} {} {}\n", q.x(), q.y(), q.z());
  }
  return text;
}

// Three sheets that meet along a line.
std::string fins() {
  Random random(3, "fins");
  std::string text;
  for (int i = 0; i < 6000; ++i) {
    const double angle = 2 * std::numbers::pi / 3 * (i % 3), r = random.uniform(0, 50);
    text += fmt::format("{} {} {}\n", r * std::cos(angle), random.uniform(0, 80), r * std::sin(angle));
  }
  return text;
}

TEST_F(ScanRefusals, AreNoSheets) {
  for (const std::string& body : {sphere(), fins()}) expect_refusal(body, "lies over itself");
  Random random(4, "cloud");
  std::vector<Vec3> cloud;
  for (int i = 0; i < 3000; ++i) cloud.push_back(20.0 * test::normal_point(random));
  EXPECT_NE(refusal(write("cloud.xyz", test::lines(cloud))), "");
}

TEST_F(ScanRefusals, OptionsThatDoNotGoWithTheFile) {
  ReadOptions scan;
  scan.scan = true;
  EXPECT_NE(refusal(write("a.svg", "<svg/>"), scan, ErrorCode::configuration).find("--scan"),
            std::string::npos);
  ReadOptions unit;
  unit.mm_per_unit = 1.0;
  EXPECT_NE(refusal(write("a.obj", "v 0 0 0"), unit, ErrorCode::configuration).find("--mm-per-unit"),
            std::string::npos);
}

}  // namespace
}  // namespace wilt
