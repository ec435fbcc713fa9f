#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/meshes.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

// Oracle: the rectangle's own area, edges and angles.
TEST(Geometry, MeasuresARectangle) {
  const test::Surface surface = test::grid(8, 4, 2.0, 1.0);
  EXPECT_NEAR(surface_area(surface.mesh, surface.positions), 2.0, 1e-14);
  EXPECT_NEAR(area_vector(surface.mesh, surface.positions).z(), 2.0, 1e-14);
  EXPECT_NEAR(smallest_angle(surface.mesh, surface.positions), std::numbers::pi / 4, 1e-14);
  EXPECT_NEAR(loop_length(surface.positions, margin_loop(surface.mesh, surface.positions)), 6.0, 1e-14);
  double lumped = 0.0;
  for (const double a : vertex_areas(surface.mesh, surface.positions)) lumped += a;
  EXPECT_NEAR(lumped, 2.0, 1e-14);
  const Points3 normals = vertex_normals(surface.mesh, surface.positions);
  EXPECT_NEAR((normals.rowwise() - Vec3(0, 0, 1).transpose()).norm(), 0.0, 1e-14);
}

// Oracle: two triangles folded by a known angle, swept through both signs and close to +-pi.
TEST(Geometry, DihedralAngleIsTheAngleOfTheFold) {
  Faces faces(2, 3);
  faces << 0, 1, 2, 1, 0, 3;
  const SurfaceMesh mesh(4, faces);
  for (const double angle : {-3.1, -1.5, -0.3, -1e-9, 0.0, 1e-9, 0.3, 1.5, 3.1}) {
    Points3 positions(4, 3);
    positions << 0, 0, 0, 0, 1, 0, -1, 0, 0, std::cos(angle), 0.5, -std::sin(angle);
    for (const EdgeId e : mesh.edges()) {
      const double expected = mesh.is_boundary(e) ? 0.0 : angle;
      EXPECT_NEAR(dihedral_angle(mesh, positions, e), expected, 1e-14) << angle;
    }
  }
}

}  // namespace
}  // namespace wilt
