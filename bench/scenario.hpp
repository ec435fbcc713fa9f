// The steps that wilt and its peers are timed on, and what each program tells about them.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bench/workload.hpp"

namespace wilt::bench {

/// The steps of one run of a problem. What counts is their median: a run is short, and its first steps and
/// the machine's interruptions are not what is asked for.
class StepTimes {
 public:
  StepTimes(benchmark::State& state, const SpringProblem& problem) : state_(state), problem_(problem) {}

  void add(double seconds) {
    state_.SetIterationTime(seconds);
    times_.push_back(seconds);
  }

  /// Counters: the median and the number of springs; the mean height and edge of the blade in the end, by
  /// which to see that all programs solve one problem.
  void report(const Points3& positions) {
    const auto middle = times_.begin() + static_cast<std::ptrdiff_t>(times_.size() / 2);
    std::nth_element(times_.begin(), middle, times_.end());
    state_.counters["median_seconds"] = *middle;
    state_.counters["springs"] = problem_.edge_count();
    state_.counters["height"] = positions.col(2).mean();
    double sum = 0.0;
    for (int e = 0; e < problem_.edge_count(); ++e)
      sum += (positions.row(problem_.edges(e, 1)) - positions.row(problem_.edges(e, 0))).norm();
    state_.counters["edge"] = sum / problem_.edge_count();
  }

 private:
  benchmark::State& state_;
  const SpringProblem& problem_;
  std::vector<double> times_;
};

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
