// Steps of the printed spring system by implicit midpoint to 1e-8.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "bench/scenario.hpp"
#include "bench/spring_system.hpp"
#include "bench/stopwatch.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"

namespace wilt::bench {
namespace {

// Time is the step's alone: rest lengths are set before it, as in the peers.
void midpoint_step(benchmark::State& state, int vertices, double stiffness) {
  const SpringProblem problem = spring_problem(vertices, stiffness);
  SpringSystem springs(problem);
  ImplicitMidpoint integrator(springs.system());
  StepTimes times(state, problem);
  MotionState motion;
  motion.positions = problem.positions;
  int step = 0, newton = 0, linear = 0;
  for (auto _ : state) {
    springs.set_rest_lengths(problem.rest_lengths(step++));
    const Stopwatch watch;
    const StepReport report = integrator.step(motion, problem.dt);
    times.add(watch.seconds());
    if (!report.converged) return state.SkipWithError(report.reason.c_str());
    newton += report.newton;
    linear += report.linear;
  }
  times.report(motion.positions);
  state.counters["newton"] = static_cast<double>(newton) / step;
  state.counters["linear"] = static_cast<double>(linear) / step;
}

// Sixteen leaves of one topology at once; a time is that of one leaf's step.
void batch_step(benchmark::State& state, int vertices, double stiffness) {
  constexpr int kLeaves = 16;
  const SpringProblem problem = spring_problem(vertices, stiffness);
  std::vector<std::unique_ptr<SpringSystem>> springs;
  std::vector<ImplicitMidpoint> integrators;
  std::vector<MotionState> motions(kLeaves);
  for (MotionState& motion : motions) {
    springs.push_back(std::make_unique<SpringSystem>(problem));
    integrators.emplace_back(springs.back()->system());
    motion.positions = problem.positions;
  }
  StepTimes times(state, problem);
  int step = 0;
  for (auto _ : state) {
    for (const auto& leaf : springs) leaf->set_rest_lengths(problem.rest_lengths(step));
    ++step;
    const Stopwatch watch;
    const std::vector<StepReport> reports = step_together(integrators, motions, problem.dt);
    times.add(watch.seconds() / kLeaves);
    for (const StepReport& report : reports) {
      if (!report.converged) return state.SkipWithError(report.reason.c_str());
    }
  }
  times.report(motions.back().positions);
}

WILT_STEP_SCENARIOS(midpoint_step);
WILT_STEP_SCENARIO(batch_step, soft_1k, 1000, 4.0);

}  // namespace
}  // namespace wilt::bench
