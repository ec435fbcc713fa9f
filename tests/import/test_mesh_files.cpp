#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <set>

#include "import/files.hpp"
#include "import/sheets.hpp"
#include "wilt/import/leaf_in_memory.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

using MeshFile = test::Files;
using test::SheetFile;

// Every file holds the same sheet: the same leaf must come out (STL, without texture, in single precision).
void expect_the_sheet(const Leaf& leaf, const SheetFile& sheet) {
  ASSERT_EQ(leaf.mesh.num_vertices(), static_cast<int>(sheet.points.size())) << test::notes_of(leaf);
  EXPECT_EQ(leaf.mesh.num_faces(), 2 * sheet.columns * sheet.rows);
  EXPECT_EQ(leaf.mesh.boundary_loops().size(), 1u);
  EXPECT_NEAR(surface_area(leaf.mesh, leaf.positions), sheet.area(), 1e-6 * sheet.area());
  // The placement gives the file's points back: (X, Y, Z) is (x, z, -y).
  std::set<int> found;
  for (const VertexId v : leaf.mesh.vertices()) {
    const Vec3 world = leaf.placement.scale * leaf.placement.rotation * leaf.positions.row(v).transpose() +
                       leaf.placement.translation;
    const Vec3 file(world.x(), world.z(), -world.y());
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
      if ((sheet.points[i] - file).norm() < 1e-6) found.insert(static_cast<int>(i));  // float32
    }
  }
  EXPECT_EQ(found.size(), sheet.points.size());
}

// Oracle: the sheet that the test wrote; its seam has one vertex more per row in the skin than in the mesh.
TEST_F(MeshFile, ObjJoinsTheSeamForThePhysicsAndKeepsItForTheSkin) {
  const SheetFile sheet;
  const Leaf leaf = read_leaf(write("sheet.obj", sheet.obj()));
  expect_the_sheet(leaf, sheet);
  EXPECT_EQ(leaf.skin.vertex.size(), sheet.points.size() + sheet.rows + 1);
  ASSERT_EQ(leaf.skin.faces.rows(), leaf.mesh.num_faces());
  for (const FaceId f : leaf.mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      const int s = leaf.skin.faces(int(f), k);
      EXPECT_EQ(leaf.skin.vertex[s], leaf.mesh.face_vertices(f)[k]);
      // u + v of a corner as written; the origin is moved from the bottom to the top.
      EXPECT_GE(leaf.skin.uv(s, 1), -1e-6);
      EXPECT_LE(leaf.skin.uv(s, 1), 1 + 1e-6);
    }
  }
  EXPECT_NEAR(leaf.skin.uv.col(0).maxCoeff(), 1.0, 1e-6);
}

// Oracle: the file's v at the lowest row is 0, which is 1 from the top.
TEST_F(MeshFile, ObjTextureCoordinatesBecomeTopLeft) {
  const SheetFile sheet;
  const Leaf leaf = read_leaf(write("sheet.obj", sheet.obj()));
  for (std::size_t s = 0; s < leaf.skin.vertex.size(); ++s) {
    const Vec3 world = leaf.placement.rotation * leaf.positions.row(leaf.skin.vertex[s]).transpose() +
                       leaf.placement.translation;
    EXPECT_NEAR(leaf.skin.uv(int(s), 1), 1.0 - (-world.y()) / sheet.height, 1e-6);
  }
}

TEST_F(MeshFile, ReadsQuadsPlyStlAndGltf) {
  const SheetFile sheet;
  expect_the_sheet(read_leaf(write("quads.obj", sheet.obj(true))), sheet);
  expect_the_sheet(read_leaf(write("sheet.ply", sheet.ply())), sheet);
  expect_the_sheet(read_leaf(write("sheet.stl", sheet.stl())), sheet);
  write("sheet.bin", sheet.gltf_buffer());
  expect_the_sheet(read_leaf(write("sheet.gltf", sheet.gltf())), sheet);
  // Moved and turned by its node: the same size, elsewhere.
  const Leaf moved = read_leaf(write("moved.gltf", sheet.gltf("\"translation\":[1,2,3],\"scale\":[2,2,2],")));
  EXPECT_NEAR(surface_area(moved.mesh, moved.positions), 4 * sheet.area(), 1e-5);
  EXPECT_EQ(moved.skin.vertex.size(), sheet.points.size() + sheet.rows + 1);
}

// Oracle: the larger of two parts; a part that is named stalk is not counted.
TEST_F(MeshFile, TakesTheLargestPieceAndLeavesTheStalkOut) {
  const SheetFile sheet;
  const std::string extra = "v 5 0 0\nv 5.01 0 0\nv 5 0 0.01\nf -3 -2 -1\n";
  const Leaf two = read_leaf(write("two.obj", sheet.obj() + extra));
  expect_the_sheet(two, sheet);
  EXPECT_TRUE(test::has_note(two, "2 separate pieces")) << test::notes_of(two);
  const std::string big_stalk = "o stalk\nv 0 0 0\nv 50 0 0\nv 0 0 50\nf -3 -2 -1\n";
  const Leaf named = read_leaf(write("named.obj", "o blade\n" + sheet.obj() + big_stalk));
  expect_the_sheet(named, sheet);
  EXPECT_TRUE(test::has_note(named, "'stalk'")) << test::notes_of(named);
}

// Oracle: the whole sheet, from halves whose borders differ by less than the tolerance.
TEST_F(MeshFile, JoinsPiecesWhoseBordersNearlyMeet) {
  SheetFile sheet;
  const Leaf leaf = read_leaf(write("halves.obj", sheet.halves_obj(1e-7)));
  EXPECT_EQ(leaf.mesh.num_vertices(), static_cast<int>(sheet.points.size())) << test::notes_of(leaf);
  EXPECT_TRUE(test::has_note(leaf, "were joined")) << test::notes_of(leaf);
  const Leaf apart = read_leaf(write("halves.obj", sheet.halves_obj(1e-4)));
  EXPECT_LT(apart.mesh.num_vertices(), static_cast<int>(sheet.points.size()));
}

// Oracle: the intact sheet.
TEST_F(MeshFile, RepairsOrientationAndDropsBadFaces) {
  const SheetFile sheet;
  const Leaf turned = read_leaf(write("turned.obj", sheet.obj(false, 7)));
  expect_the_sheet(turned, sheet);
  EXPECT_TRUE(test::has_note(turned, "were turned over")) << test::notes_of(turned);
  const Leaf whole = read_leaf(write("whole.obj", sheet.obj()));
  const Vec3 up = turned.placement.rotation.col(2), expected = whole.placement.rotation.col(2);
  EXPECT_GT(up.dot(expected), 0.99);
  // The first face again, one without area, and an unused vertex.
  const Leaf messy = read_leaf(
      write("messy.obj", sheet.obj() + fmt::format("f 1/1 {0}/{0} {1}/{1}\nf 1/1 2/2 2/2\nv 9 9 9\n",
                                                   sheet.at(0, 1) + 1, sheet.at(1, 1) + 1)));
  expect_the_sheet(messy, sheet);
  EXPECT_TRUE(test::has_note(messy, "1 repeated")) << test::notes_of(messy);
}

// Oracle: the corner asked for, in the two coordinates that the flat leaf spans (x and z).
TEST_F(MeshFile, TakesTheGivenPetiole) {
  const SheetFile sheet;
  ReadOptions options;
  options.petiole = Vec2(sheet.width, 0);
  const Leaf leaf = read_leaf(write("sheet.obj", sheet.obj()), options);
  EXPECT_NEAR(leaf.placement.translation.x(), sheet.width, 1e-6);
  EXPECT_NEAR(leaf.placement.translation.y(), 0.0, 1e-6);
}

TEST_F(MeshFile, SaysWhenTheLengthIsImplausible) {
  SheetFile sheet;
  for (Vec3& p : sheet.points) p *= 100;
  EXPECT_TRUE(test::has_note(read_leaf(write("sheet.obj", sheet.obj())), "no leaf is"));
}

TEST_F(MeshFile, RefusesWhatIsNoSheet) {
  EXPECT_NE(refusal(write("x.obj", "nonsense")).find("'x.obj'"), std::string::npos);
  EXPECT_NE(refusal(write("x.glb", "nonsense")).find("cannot be read as a mesh"), std::string::npos);
  EXPECT_NE(
      refusal(write("closed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"))
          .find("closed"),
      std::string::npos);
  EXPECT_NE(refusal(write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")).find("without area"),
            std::string::npos);
  EXPECT_NE(
      refusal(write("book.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv -1 0 0\nv 0 1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n")),
      "");
  // A strip of triangles, glued with a half turn.
  std::string moebius;
  const int n = 24;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * 3.14159265358979 * i / n;
    for (const double w : {-0.3, 0.3})
      moebius += fmt::format("v {} {} {}\n", (1 + w * std::cos(t / 2)) * std::cos(t),
                             (1 + w * std::cos(t / 2)) * std::sin(t), w * std::sin(t / 2));
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i + 1, b = 2 * i + 2;
    const int c = i + 1 < n ? a + 2 : 2, d = i + 1 < n ? b + 2 : 1;
    moebius += fmt::format("f {} {} {}\nf {} {} {}\n", a, c, b, b, c, d);
  }
  EXPECT_NE(refusal(write("moebius.obj", moebius)).find("one side"), std::string::npos);
}

// Oracle: the same sheet as a file, which holds it in single precision.
TEST_F(MeshFile, ArraysAreReadAsAFileIs) {
  const SheetFile sheet;
  const Leaf file = read_leaf(write("sheet.obj", sheet.obj()));
  const MeshArrays arrays{file.positions, file.mesh.face_matrix(), {}, static_cast<int>(file.petiole)};
  const Leaf leaf = leaf_from_arrays(arrays, "mine");
  EXPECT_EQ(leaf.name, "mine");
  EXPECT_EQ(leaf.petiole, file.petiole);
  EXPECT_LT((leaf.positions - file.positions).cwiseAbs().maxCoeff(), 1e-12 * leaf_length(file));
  EXPECT_TRUE(test::has_note(leaf, "no texture coordinates")) << test::notes_of(leaf);
  // With the seam of its skin: one position twice, two texture coordinates.
  MeshArrays skinned{Points3(file.skin.uv.rows(), 3), file.skin.faces, file.skin.uv, {}};
  for (std::size_t k = 0; k < file.skin.vertex.size(); ++k)
    skinned.positions.row(static_cast<int>(k)) = file.positions.row(file.skin.vertex[k]);
  const Leaf seamed = leaf_from_arrays(skinned, "seamed");
  EXPECT_EQ(seamed.mesh.num_vertices(), file.mesh.num_vertices());
  EXPECT_EQ(seamed.skin.uv.rows(), file.skin.uv.rows());
}

// Oracle: planted faults, each named; and a margin vertex beside an inner petiole.
TEST(MeshArrays, AreRefusedOrMendedLikeAFile) {
  Points3 square(5, 3);
  square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.4, 0;
  Faces fan(4, 3);
  fan << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
  const auto refusal = [](const MeshArrays& mesh) -> std::string {
    try {
      leaf_from_arrays(mesh, "mine");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({square, fan, {}, {}}), "");
  Faces beyond = fan;
  beyond(2, 1) = 5;
  EXPECT_EQ(refusal({square, beyond, {}, {}}),
            "'mine': face 2 has vertex 5, but there are 5 (counted from 0); remove the face");
  beyond(2, 1) = -1;
  EXPECT_NE(refusal({square, beyond, {}, {}}).find("vertex -1"), std::string::npos);
  EXPECT_NE(refusal({square, Faces(0, 3), {}, {}}).find("no face"), std::string::npos);
  EXPECT_NE(refusal({square, fan, Points2(4, 2), {}}).find("4 texture coordinates"), std::string::npos);
  EXPECT_NE(refusal({square, fan, {}, 5}).find("petiole is position 5"), std::string::npos);
  Points3 broken = square;
  broken(3, 1) = std::nan("");
  EXPECT_NE(refusal({broken, fan, {}, {}}).find("finite"), std::string::npos);
  const Leaf leaf = leaf_from_arrays({square, fan, {}, 2}, "mine");
  EXPECT_NEAR((leaf.positions.row(leaf.petiole)).norm(), 0.0, 0.0);
  EXPECT_NEAR(leaf_length(leaf), std::sqrt(2.0), 1e-15);
  const Leaf inner = leaf_from_arrays({square, fan, {}, 4}, "mine");  // nearest: 0 or 1, the first of them
  EXPECT_TRUE(inner.mesh.is_boundary(inner.petiole));
}

}  // namespace
}  // namespace wilt
