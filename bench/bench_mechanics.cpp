// Steps of the printed spring system by implicit midpoint to 1e-8.
#include <benchmark/benchmark.h>

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

WILT_STEP_SCENARIOS(midpoint_step);

}  // namespace
}  // namespace wilt::bench
