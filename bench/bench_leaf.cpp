// Leaves of a species, from outline to mesh.
#include <benchmark/benchmark.h>

#include "wilt/leaf/species.hpp"

namespace wilt::bench {
namespace {

void make_maple(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(make_leaf("maple", static_cast<int>(state.range(0)), 1));
}
BENCHMARK(make_maple)
    ->Arg(2000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
