// Distances on the workload's surface: near-exact and exact.
#include <benchmark/benchmark.h>

#include "bench/geodesic_error.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"

namespace wilt::bench {
namespace {

void fast_all_pairs(benchmark::State& state) {
  const Surface surface = leaf_surface(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast));
  const FastGeodesics fast(surface.mesh, surface.positions);
  report_error(state, surface, [&](VertexId source) { return fast.distances(source); });
}
BENCHMARK(fast_all_pairs)->Arg(1000)->Arg(5000)->UseRealTime()->Unit(benchmark::kMillisecond);

// Set-up included, as in the peers.
template <class Geodesics>
void one_source(benchmark::State& state) {
  const Surface surface = leaf_surface(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const Geodesics geodesics(surface.mesh, surface.positions);
    benchmark::DoNotOptimize(geodesics.distances(VertexId(0)));
  }
}
BENCHMARK(one_source<FastGeodesics>)
    ->Name("fast_one_source")
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(one_source<ExactGeodesics>)
    ->Name("exact_one_source")
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
