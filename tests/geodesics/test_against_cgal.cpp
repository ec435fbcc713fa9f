#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "geodesics/leaf_surface.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"

namespace wilt {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using CgalPaths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>>;

CgalMesh cgal_mesh(const test::Surface& surface) {
  CgalMesh mesh;
  for (const VertexId v : surface.mesh.vertices()) {
    const Vec3 p = surface.positions.row(v);
    mesh.add_vertex({p.x(), p.y(), p.z()});
  }
  using Index = CgalMesh::Vertex_index;
  for (const FaceId f : surface.mesh.faces()) {
    const auto [a, b, c] = surface.mesh.face_vertices(f);
    mesh.add_face(Index(int(a)), Index(int(b)), Index(int(c)));
  }
  return mesh;
}

struct Case {
  const char* name;
  int rings;
  test::LeafShape shape;
};

class AgainstCgal : public testing::TestWithParam<Case> {};

// Oracle: CGAL's exact solver (Xin and Wang's algorithm, in double). Both round at every unfolding, some
// dozens a path: 1e-12 leaves two digits over what we see (1e-14).
TEST_P(AgainstCgal, ExactDistancesAgree) {
  const Case& c = GetParam();
  const test::Surface surface = test::leaf(c.rings, c.shape);
  const ExactGeodesics geodesics(surface.mesh, surface.positions);
  const CgalMesh mesh = cgal_mesh(surface);
  const int n = surface.mesh.num_vertices();
  double worst = 0.0, sum = 0.0;
  int count = 0;
  for (const int source : {0, n / 3, n - 1}) {
    CgalPaths oracle(mesh);
    oracle.add_source_point(CgalMesh::Vertex_index(source));
    oracle.build_sequence_tree();
    const Eigen::VectorXd distances = geodesics.distances(VertexId(source));
    for (int v = 0; v < n; ++v) {
      if (v == source) continue;
      const double expected = oracle.shortest_distance_to_source_points(CgalMesh::Vertex_index(v)).first;
      const double error = std::abs(distances[v] - expected) / expected;
      worst = std::max(worst, error);
      sum += error;
      ++count;
    }
  }
  std::printf("%s: %d vertices, relative error mean %.1e, max %.1e\n", c.name, n, sum / count, worst);
  EXPECT_LT(worst, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Leaves, AgainstCgal,
    testing::Values(Case{"flat_lobes", 9, {.bumps = 0.0}},
                    Case{"gentle_bumps", 12, {.bumps = 0.05, .seed = 2}},
                    Case{"steep_bumps_and_hole", 12, {.bumps = 0.3, .hole = true, .seed = 3}},
                    Case{"deep_lobes", 10, {.lobes = 7, .depth = 0.6, .bumps = 0.1, .seed = 4}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace wilt
