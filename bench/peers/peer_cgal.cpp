// CGAL: exact distances (Surface_mesh_shortest_path, Xin and Wang's algorithm) and the heat method.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <benchmark/benchmark.h>

#include "bench/geodesic_error.hpp"
#include "bench/workload.hpp"

namespace wilt::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Index = Mesh::Vertex_index;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
using Heat = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh, CGAL::Heat_method_3::Direct>;

Mesh cgal_mesh(const Surface& surface) {
  Mesh mesh;
  for (int v = 0; v < surface.positions.rows(); ++v)
    mesh.add_vertex({surface.positions(v, 0), surface.positions(v, 1), surface.positions(v, 2)});
  const Faces& faces = surface.mesh.face_matrix();
  for (int f = 0; f < faces.rows(); ++f)
    mesh.add_face(Index(faces(f, 0)), Index(faces(f, 1)), Index(faces(f, 2)));
  return mesh;
}

void exact_one_source(benchmark::State& state) {
  const Mesh mesh = cgal_mesh(leaf_surface(static_cast<int>(state.range(0))));
  for (auto _ : state) {
    Paths paths(mesh);
    paths.add_source_point(Index(0));
    paths.build_sequence_tree();
    double sum = 0.0;
    for (const Index v : mesh.vertices()) sum += paths.shortest_distance_to_source_points(v).first;
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(exact_one_source)->Arg(1000)->Arg(10000)->UseRealTime()->Unit(benchmark::kMillisecond);

Eigen::VectorXd heat_distances(const Mesh& mesh, Heat& heat, Mesh::Property_map<Index, double> map,
                               int source) {
  heat.clear_sources();
  heat.add_source(Index(source));
  heat.estimate_geodesic_distances(map);
  Eigen::VectorXd distances(mesh.number_of_vertices());
  for (const Index v : mesh.vertices()) distances[v] = map[v];
  return distances;
}

void heat_all_pairs(benchmark::State& state) {
  const Surface surface = leaf_surface(static_cast<int>(state.range(0)));
  Mesh mesh = cgal_mesh(surface);
  const auto map = mesh.add_property_map<Index, double>("v:distance", 0.0).first;
  const int count = surface.mesh.num_vertices();
  for (auto _ : state) {
    Heat heat(mesh);
    for (int source = 0; source < count; ++source) heat_distances(mesh, heat, map, source);
  }
  Heat heat(mesh);
  report_error(state, surface, [&](VertexId source) { return heat_distances(mesh, heat, map, source); });
}
BENCHMARK(heat_all_pairs)->Arg(1000)->Arg(5000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
