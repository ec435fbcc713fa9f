#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <utility>

#include "support/meshes.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mesh/surface_mesh.hpp"
#include "wilt/mesh/validate.hpp"

namespace wilt {
namespace {

template <class Data, class Id>
concept IndexableBy = requires(Data data, Id id) {
  data[id];
};

// Oracle: the compiler.
TEST(ElementData, IndexingVertexDataByAFaceDoesNotCompile) {
  static_assert(IndexableBy<VertexData<double>, VertexId>);
  static_assert(!IndexableBy<VertexData<double>, FaceId>);
  static_assert(!IndexableBy<VertexData<double>, int>);
  static_assert(!std::is_constructible_v<VertexId, FaceId>);
}

Faces faces_of(std::initializer_list<std::array<int, 3>> list) {
  Faces faces(static_cast<int>(list.size()), 3);
  int row = 0;
  for (const auto& f : list) faces.row(row++) << f[0], f[1], f[2];
  return faces;
}

std::string message_of(int vertices, const Faces& faces) {
  try {
    const SurfaceMesh mesh(vertices, faces);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "";
}

// Oracle: the half-edge axioms and Euler's formula V - E + F = 2 - 2g - b.
TEST(SurfaceMesh, ObeysTheHalfedgeAxiomsOnAGridWithAHole) {
  const test::Surface whole = test::grid(6, 5);
  Faces kept(whole.mesh.num_faces() - 2, 3);  // without the two faces of the middle cell
  for (int f = 0, row = 0; f < whole.mesh.num_faces(); ++f) {
    if (f / 2 != 2 * 6 + 3) kept.row(row++) = whole.mesh.face_matrix().row(f);
  }
  const SurfaceMesh mesh(whole.mesh.num_vertices(), kept);
  ASSERT_EQ(mesh.boundary_loops().size(), 2u);
  EXPECT_EQ(mesh.num_vertices() - mesh.num_edges() + mesh.num_faces(), 2 - 2);
  for (int i = 0; i < mesh.num_halfedges(); ++i) {
    const HalfedgeId h(i);
    EXPECT_EQ(mesh.twin(mesh.twin(h)), h);
    EXPECT_NE(mesh.twin(h), h);
    EXPECT_EQ(mesh.edge(h), mesh.edge(mesh.twin(h)));
    EXPECT_EQ(mesh.from(mesh.next(h)), mesh.to(h));
    EXPECT_EQ(mesh.prev(mesh.next(h)), h);
    EXPECT_EQ(mesh.next(mesh.prev(h)), h);
    EXPECT_EQ(mesh.is_boundary(h), mesh.is_boundary(mesh.next(h)));
  }
  int degrees = 0;
  for (const VertexId v : mesh.vertices()) {
    mesh.for_outgoing(v, [&](HalfedgeId h) {
      EXPECT_EQ(mesh.from(h), v);
      ++degrees;
    });
    EXPECT_EQ(mesh.is_boundary(v), mesh.is_boundary(mesh.halfedge(v)));
  }
  EXPECT_EQ(degrees, mesh.num_halfedges());
  EXPECT_EQ(mesh.boundary_loops()[0].size() + mesh.boundary_loops()[1].size(), 22u + 4u);
}

// Oracle: the signed area of the loop, which is negative for a clockwise one.
TEST(SurfaceMesh, BoundaryLoopsRunClockwise) {
  const test::Surface surface = test::grid(3, 2);
  const auto& loop = surface.mesh.boundary_loops().at(0);
  double area = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = surface.positions.row(loop[i]), b = surface.positions.row(loop[(i + 1) % loop.size()]);
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  EXPECT_DOUBLE_EQ(area, -1.0);
}

TEST(SurfaceMesh, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(message_of(3, Faces(0, 3)).find("no faces"), std::string::npos);
  EXPECT_NE(message_of(3, faces_of({{0, 1, 3}})).find("face 0 refers to vertex 3"), std::string::npos);
  EXPECT_NE(message_of(3, faces_of({{0, 1, 1}})).find("face 0 uses a vertex twice"), std::string::npos);
  EXPECT_NE(message_of(5, faces_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})).find("vertices 0 and 1 has 3 faces"),
            std::string::npos);
  EXPECT_NE(message_of(4, faces_of({{0, 1, 2}, {0, 1, 3}})).find("faces 0 and 1"), std::string::npos);
  EXPECT_NE(message_of(5, faces_of({{0, 1, 2}, {0, 3, 4}})).find("only at vertex 0"), std::string::npos);
  EXPECT_NE(message_of(4, faces_of({{0, 1, 2}})).find("vertex 3 belongs to no face"), std::string::npos);
}

TEST(SurfaceMesh, RefusesFansThatMeetAtAnInteriorVertex) {
  // Two closed tetrahedra that share vertex 0.
  const Faces faces =
      faces_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
  EXPECT_NE(message_of(7, faces).find("only at vertex 0"), std::string::npos);
}

TEST(ValidateBlade, RefusesWhatCannotBeALeaf) {
  test::Surface good = test::grid(2, 2);
  EXPECT_NO_THROW(validate_blade(good.mesh, good.positions));

  test::Surface nan = good;
  nan.positions(4, 1) = std::nan("");
  EXPECT_THROW(validate_blade(nan.mesh, nan.positions), Error);

  test::Surface flat = good;
  flat.positions.row(4) = flat.positions.row(3);
  EXPECT_THROW(validate_blade(flat.mesh, flat.positions), Error);

  const SurfaceMesh closed(4, faces_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
  Points3 tetrahedron(4, 3);
  tetrahedron << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  EXPECT_THROW(validate_blade(closed, tetrahedron), Error);

  const SurfaceMesh two(6, faces_of({{0, 1, 2}, {3, 4, 5}}));
  Points3 apart(6, 3);
  apart << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  EXPECT_THROW(validate_blade(two, apart), Error);
}

}  // namespace
}  // namespace wilt
