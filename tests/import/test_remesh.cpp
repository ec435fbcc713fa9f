#include "import/files.hpp"
#include "import/sheets.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using Remesh = test::Files;

ReadOptions with_vertices(int count) {
  ReadOptions options;
  options.vertices = count;
  return options;
}

std::string obj_of(const Leaf& leaf) {
  std::string text;
  for (const VertexId v : leaf.mesh.vertices())
    text += fmt::format("v {} {} {}\n", leaf.positions(int(v), 0), leaf.positions(int(v), 2),
                        -leaf.positions(int(v), 1));
  for (int f = 0; f < leaf.mesh.num_faces(); ++f) {
    const auto face = leaf.mesh.face_matrix().row(f);
    text += fmt::format("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
  }
  return text;
}

// Oracle: the sheet's own texture map, linear on either side of the seam: u = 0.8 s on the left and
// 0.2 + 0.8 s on the right, so each face lies within one chart and none spans the gap between 0.4 and 0.6.
TEST_F(Remesh, CarriesTextureCoordinatesPerChart) {
  const test::SheetFile sheet;
  const Leaf leaf = read_leaf(write("sheet.obj", sheet.obj()), with_vertices(1000));
  EXPECT_NEAR(leaf.mesh.num_vertices(), 1000, 50);
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), sheet.area(), 0.02 * sheet.area());
  ASSERT_EQ(leaf.skin.faces.rows(), leaf.mesh.num_faces());
  EXPECT_GT(leaf.skin.vertex.size(), static_cast<std::size_t>(leaf.mesh.num_vertices()));
  for (int f = 0; f < leaf.skin.faces.rows(); ++f) {
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) {
      const int s = leaf.skin.faces(f, k);
      ASSERT_EQ(int(leaf.skin.vertex[s]), leaf.mesh.face_matrix()(f, k));
      left += leaf.skin.uv(s, 0) <= 0.4 + 1e-6;
      right += leaf.skin.uv(s, 0) >= 0.6 - 1e-6;
      const Vec3 world = leaf.placement.rotation * leaf.positions.row(leaf.skin.vertex[s]).transpose() +
                         leaf.placement.translation;
      EXPECT_NEAR(leaf.skin.uv(s, 1), 1.0 - (-world.y()) / sheet.height, 1e-3);
    }
    EXPECT_TRUE(left == 3 || right == 3) << f;
  }
}

// Oracle: a procedural leaf; its petiole, length and area survive being exported and remeshed.
TEST_F(Remesh, KeepsAProceduralLeafsPetioleAndSize) {
  const Leaf maple = make_leaf("maple", 800, 2);
  const Leaf leaf = read_leaf(write("m.obj", obj_of(maple)), with_vertices(1500));
  EXPECT_NEAR(leaf.mesh.num_vertices(), 1500, 75);
  EXPECT_NEAR(leaf_length(leaf), leaf_length(maple), 0.02 * leaf_length(maple));
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), surface_area(maple.mesh, maple.positions),
              0.03 * surface_area(maple.mesh, maple.positions));
  // The petiole was the origin; meshing rounds the sharp notch by less than an edge.
  EXPECT_LT(leaf.placement.translation.norm(), mean_edge_length(leaf.mesh, leaf.positions));
}

// Oracle: the petiole vertex of the leaf that was exported; single precision moves it by 1e-8 m.
TEST_F(Remesh, ReadBackLeavesKeepTheirPetiole) {
  for (const std::string& name : species_names()) {
    const Leaf made = make_leaf(name, 800, 4);
    const Leaf read = read_leaf(write("x.obj", obj_of(made)));
    ASSERT_EQ(read.mesh.num_vertices(), made.mesh.num_vertices());
    EXPECT_LT(read.placement.translation.norm(), 1e-7) << name;
    EXPECT_NEAR(leaf_length(read), leaf_length(made), 1e-7) << name;
  }
}

// Oracle: half a cylinder cannot be projected (its sides stand upright) but unrolls; its area is pi r h.
TEST_F(Remesh, UnrollsWhatCannotBeProjected) {
  const double pi = 3.14159265358979, radius = 0.02, height = 0.1;
  std::string text;
  const int columns = 24, rows = 20;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double t = 1.2 * pi * (double(i) / columns - 0.5);
      text += fmt::format("v {} {} {}\n", radius * std::sin(t), radius * std::cos(t), height * j / rows);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i + 1, b = a + columns + 1;
      text += fmt::format("f {} {} {} {}\n", a, b, b + 1, a + 1);
    }
  }
  const Leaf leaf = read_leaf(write("rolled.obj", text), with_vertices(600));
  const double area = 1.2 * pi * radius * height;
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), area, 0.03 * area);
  EXPECT_NEAR(leaf.mesh.num_vertices(), 600, 30);
}

}  // namespace
}  // namespace wilt
