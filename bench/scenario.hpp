// The steps that wilt and its peers are timed on, and what each program tells about them.
#pragma once

#include <benchmark/benchmark.h>

#include "bench/workload.hpp"

namespace wilt::bench {

/// The number of springs, and where the blade is in the end: two numbers by which scripts/performance sees
/// that all programs solve one problem.
inline void report_motion(benchmark::State& state, const SpringProblem& problem, const Points3& positions) {
  state.counters["springs"] = problem.edge_count();
  state.counters["height"] = positions.col(2).mean();
  double sum = 0.0;
  for (int e = 0; e < problem.edge_count(); ++e)
    sum += (positions.row(problem.edges(e, 1)) - positions.row(problem.edges(e, 0))).norm();
  state.counters["edge"] = sum / problem.edge_count();
}

}  // namespace wilt::bench

/// The scenarios of a function (state, vertices, stiffness) that times each step by itself.
#define WILT_STEP_SCENARIO(function, name, vertices, stiffness) \
  BENCHMARK_CAPTURE(function, name, vertices, stiffness)        \
      ->Iterations(wilt::bench::timed_steps(vertices))          \
      ->UseManualTime()                                         \
      ->Unit(benchmark::kMillisecond)
#define WILT_STEP_SCENARIOS(function)                     \
  WILT_STEP_SCENARIO(function, soft_1k, 1000, 4.0);       \
  WILT_STEP_SCENARIO(function, soft_10k, 10000, 4.0);     \
  WILT_STEP_SCENARIO(function, soft_100k, 100000, 4.0);   \
  WILT_STEP_SCENARIO(function, soft_1M, 1000000, 4.0);    \
  WILT_STEP_SCENARIO(function, stiff_2k, 2000, 1000.0);   \
  WILT_STEP_SCENARIO(function, stiff_5k, 5000, 1000.0);   \
  WILT_STEP_SCENARIO(function, stiff_10k, 10000, 1000.0); \
  WILT_STEP_SCENARIO(function, stiff_100k, 100000, 1000.0)
