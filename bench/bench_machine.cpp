// What the machine can do: memory bandwidth by size of the working set, and arithmetic in registers.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <thread>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/simd.hpp"

namespace wilt::bench {
namespace {

// The loop of McCalpin's STREAM: two arrays read, one written. 24 bytes count for an element; that the cache
// reads a line before it writes to it does not count.
WILT_CLONES void triad_range(double* a, const double* b, const double* c, int begin, int end) {
  const Double8 factor = Double8{} + 3.0;
  for (int i = begin; i < end; i += simd::kLanes)
    simd::store(a + i, simd::load(b + i) + factor * simd::load(c + i));
}

// Argument: bytes of the three arrays. Every thread has its own part of them.
void triad(benchmark::State& state) {
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  const int part = static_cast<int>(state.range(0) / 24 / threads / simd::kLanes * simd::kLanes);
  const int count = threads * part;
  const int passes = std::max(1, 4000000 / count);  // so that starting threads does not count
  Eigen::VectorXd a = Eigen::VectorXd::Zero(count), b = Eigen::VectorXd::Ones(count), c = b;
  for (auto _ : state) {
    parallel_for(threads, 1, [&](int begin, int end) {
      for (int pass = 0; pass < passes; ++pass) {
        triad_range(a.data(), b.data(), c.data(), begin * part, end * part);
        benchmark::ClobberMemory();
      }
    });
  }
  state.SetBytesProcessed(state.iterations() * passes * count * std::int64_t{24});
}
BENCHMARK(triad)->Arg(30000)->Arg(750000)->Arg(6000000)->Arg(48000000)->Arg(400000000)->UseRealTime();

constexpr int kChains = 12;     // independent, so that no result is waited for
constexpr int kRounds = 20000;  // of all chains

WILT_CLONES double multiply_and_add() {
  std::array<Double8, kChains> values{};
  const Double8 factor = Double8{} + 0.999, term = Double8{} + 0.001;
  for (int round = 0; round < kRounds; ++round) {
    for (Double8& value : values) value = value * factor + term;
  }
  Double8 sum{};
  for (const Double8& value : values) sum += value;
  return simd::sum(sum);
}

WILT_CLONES double divide_by_roots() {
  std::array<Double8, kChains> values{};
  for (Double8& value : values) value += 2.0;
  for (int round = 0; round < kRounds; ++round) {
    for (Double8& value : values) value = 3.0 / simd::sqrt(value);
  }
  Double8 sum{};
  for (const Double8& value : values) sum += value;
  return simd::sum(sum);
}

// Operations a second on one thread; products and sums are not contracted, as everywhere in wilt.
template <class Kernel>
void arithmetic(benchmark::State& state, const Kernel& kernel) {
  for (auto _ : state) benchmark::DoNotOptimize(kernel());
  state.counters["operations"] = benchmark::Counter(2.0 * simd::kLanes * kChains * kRounds,
                                                    benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(arithmetic, products_and_sums, multiply_and_add);
BENCHMARK_CAPTURE(arithmetic, roots_and_quotients, divide_by_roots);

// All processors at once: on a quiet machine, processor time is real time times their number.
void all_processors(benchmark::State& state) {
  for (auto _ : state) {
    std::vector<std::thread> threads(std::thread::hardware_concurrency());
    for (std::thread& thread : threads) {
      thread = std::thread([] {
        for (int k = 0; k < 100; ++k) benchmark::DoNotOptimize(multiply_and_add());
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
}
BENCHMARK(all_processors)->Iterations(50)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace wilt::bench
