// Water moving from cell to cell.
#include <benchmark/benchmark.h>

#include "bench/workload.hpp"
#include "wilt/water/permeation.hpp"

namespace wilt::bench {
namespace {

void permeation(benchmark::State& state) {
  const SpringProblem problem = spring_problem(static_cast<int>(state.range(0)), 4.0);
  const Eigen::VectorXd rest = 8.0 * problem.first_rest;  // the working length of a simulated leaf
  Permeation cells(problem.vertex_count(), problem.edges, rest);
  const Eigen::VectorXd dry = 0.2 * problem.masses, fresh = 0.8 * problem.masses;
  const Eigen::VectorXd loss = Eigen::VectorXd::Constant(problem.vertex_count(), 0.01);
  WaterReport report;
  for (auto _ : state) {
    Eigen::VectorXd water = fresh;
    report = cells.step(dry, water, loss, problem.dt);
    benchmark::DoNotOptimize(water.data());
  }
  state.counters["iterations"] = report.iterations;
}
BENCHMARK(permeation)->Arg(2000)->Arg(10000)->Arg(100000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
