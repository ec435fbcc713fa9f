#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "import/files.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using JsonOutline = test::Files;

// An egg, wide below, apex up, 2 units long, 1 unit wide; `turn` radians round.
std::string egg(double turn = 0.0) {
  std::string points;
  for (int i = 0; i < 240; ++i) {
    const double t = 2 * std::numbers::pi * i / 240;
    const double x = 0.5 * std::sin(t) * (1 - 0.35 * std::cos(t)), y = std::cos(t);
    points += fmt::format("{}[{}, {}]", i > 0 ? "," : "", std::cos(turn) * x - std::sin(turn) * y,
                          std::sin(turn) * x + std::cos(turn) * y);
  }
  return "[" + points + "]";
}

ReadOptions small() {
  ReadOptions options;
  options.vertices = 300;
  return options;
}

// Oracle: the outline's own length, its base, and the leaf frame.
TEST_F(JsonOutline, BecomesALeafInMetres) {
  const Leaf leaf = read_leaf(
      write("egg.json", fmt::format("{{\"outline\": {}, \"mm_per_unit\": 40}}", egg(1.0))), small());
  EXPECT_EQ(leaf.name, "egg");
  EXPECT_EQ(leaf.species, "generic");
  EXPECT_NEAR(leaf.mesh.num_vertices(), 300, 15);
  EXPECT_NEAR(leaf_length(leaf), 0.080, 0.002);  // half an edge at either end
  EXPECT_EQ(leaf.positions.row(leaf.petiole).norm(), 0.0);
  // It faces up, and has the gentle relief of a fresh leaf: slopes of some tenths cost a few percent of the
  // area.
  const double area = surface_area(leaf.mesh, leaf.positions);
  EXPECT_GT(area_vector(leaf.mesh, leaf.positions).z(), 0.93 * area);
  EXPECT_LT(area_vector(leaf.mesh, leaf.positions).z(), 0.9999 * area);
  EXPECT_EQ(leaf.skin.faces.rows(), leaf.mesh.num_faces());
  // The base lies at -(turned y axis) in the file.
  EXPECT_LT((leaf.placement.translation - Vec3(std::sin(1.0), -std::cos(1.0), 0)).norm(), 0.08);
}

// Oracle: the given point, projected onto the margin; meshing may move it by a fraction of an edge (0.07).
TEST_F(JsonOutline, TakesThePetioleFromTheFileOrTheUser) {
  const std::string with =
      fmt::format("{{\"outline\": {}, \"petiole\": [0, 1.1], \"mm_per_unit\": 40}}", egg());
  EXPECT_LT((read_leaf(write("a.json", with), small()).placement.translation - Vec3(0, 1, 0)).norm(), 0.03);
  ReadOptions options = small();
  options.petiole = Vec2(0.52, 0.0);
  EXPECT_LT((read_leaf(write("a.json", with), options).placement.translation - Vec3(0.5, 0, 0)).norm(), 0.03);
}

// Oracle: a leaf with a hole has two boundary loops, and lacks the hole's area (0.04 of the square).
TEST_F(JsonOutline, KeepsHoles) {
  const Leaf leaf = read_leaf(write("holed.json",
                                    "{\"outline\": [[0,0],[1,0],[1,1],[0,1]], \"mm_per_unit\": 100,"
                                    "\"holes\": [[[0.4,0.4],[0.6,0.4],[0.6,0.6],[0.4,0.6]]]}"),
                              small());
  EXPECT_EQ(leaf.mesh.boundary_loops().size(), 2u);
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), 0.0096, 2e-4);  // corners are rounded by an edge
}

TEST_F(JsonOutline, RefusesWhatItDoesNotKnow) {
  const auto message = [&](const std::string& text) { return refusal(write("x.json", text)); };
  EXPECT_NE(message("{\"outline\": [[0,0],[1,0],[1,1]], \"petole\": [0,0]}").find("did you mean 'petiole'"),
            std::string::npos);
  EXPECT_NE(message("{\"holes\": []}").find("\"outline\" is missing"), std::string::npos);
  EXPECT_NE(message("[1, 2]").find("must be an object"), std::string::npos);
  EXPECT_NE(message("{\"outline\": ").find("not JSON"), std::string::npos);
  EXPECT_NE(message("{\"outline\": [[0,0],[1,0],[1,\"1\"]]}").find("outline[2][1] is \"1\""),
            std::string::npos);
  EXPECT_NE(message("{\"outline\": [[0,0],[1,0],[1,1,1]]}").find("outline[2] is [1,1,1]"), std::string::npos);
  EXPECT_NE(message("{\"outline\": [[0,0],[1,0]]}").find("three points"), std::string::npos);
  EXPECT_NE(message("{\"outline\": [[0,0],[1,0],[1,1]], \"mm_per_unit\": 0}").find("above 0"),
            std::string::npos);
  EXPECT_NE(message("{\"outline\": [[0,0],[1,1],[1,0],[0,1]]}").find("x.json"), std::string::npos);
}

// Oracle: a length that no leaf has is said.
TEST_F(JsonOutline, SaysWhenTheLengthIsImplausible) {
  const Leaf leaf =
      read_leaf(write("tiny.json", fmt::format("{{\"outline\": {}, \"mm_per_unit\": 0.1}}", egg())), small());
  EXPECT_TRUE(test::has_note(leaf, "no leaf is")) << test::notes_of(leaf);
}

}  // namespace
}  // namespace wilt
