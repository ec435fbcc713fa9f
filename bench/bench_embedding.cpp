// Scaling a leaf's distances into the plane.
#include <benchmark/benchmark.h>

#include "bench/stopwatch.hpp"
#include "bench/workload.hpp"
#include "wilt/embedding/embedding.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"

namespace wilt::bench {
namespace {

Eigen::MatrixXd leaf_distances(int vertices) {
  const Surface surface = leaf_surface(vertices);
  return all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast);
}

// A whole call from the classical start, checks included, over the iterations that it made: as the peer is
// measured. The counter is the stress at convergence.
void smacof_iteration(benchmark::State& state) {
  const Eigen::MatrixXd distances = leaf_distances(2000);
  const Points2 start = classical_mds(distances).coordinates;
  constexpr int kIterations = 30;
  for (auto _ : state) {
    const Stopwatch watch;
    const Embedding made = smacof(distances, start, {kIterations, 1e-300});
    state.SetIterationTime(watch.seconds() / static_cast<double>(made.history.size()));
  }
  state.counters["stress"] = smacof(distances, start, {1000, 1e-7}).stress;
}
BENCHMARK(smacof_iteration)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);

void classical_start(benchmark::State& state) {
  const Eigen::MatrixXd distances = leaf_distances(2000);
  for (auto _ : state) benchmark::DoNotOptimize(classical_mds(distances));
}
BENCHMARK(classical_start)->UseRealTime()->Unit(benchmark::kMillisecond);

void landmarks(benchmark::State& state) {
  const Surface surface = leaf_surface(static_cast<int>(state.range(0)));
  const std::vector<VertexId> sources = spread_sources(surface.mesh, 60);
  const Eigen::MatrixXd distances =
      geodesic_distances(surface.mesh, surface.positions, sources, GeodesicMethod::fast);
  const std::vector<int> columns(sources.begin(), sources.end());
  for (auto _ : state) benchmark::DoNotOptimize(landmark_mds(distances, columns));
}
BENCHMARK(landmarks)->Arg(10000)->Arg(100000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
