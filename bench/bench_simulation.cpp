// The models as the stepper runs them, and what is measured and painted after the steps.
#include <benchmark/benchmark.h>

#include "bench/maple.hpp"
#include "bench/stopwatch.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/leaf_relief.hpp"
#include "wilt/simulation/leaf_texture.hpp"
#include "wilt/simulation/metrics.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::bench {
namespace {

// Time is the step's alone; the water's and forces' update before it is the counter "advance_seconds".
void model_step(benchmark::State& state, const char* name, int vertices) {
  const Maple maple(vertices, name);
  const double scale = kWorkingLength / leaf_length(maple.leaf);
  const auto model =
      make_model({maple.leaf, maple.venation, maple.config, scale, scale * maple.leaf.positions});
  ImplicitMidpoint integrator(model->system());
  MotionState motion;
  motion.positions = scale * maple.leaf.positions;
  double advance = 0.0;
  int newton = 0, linear = 0;
  for (auto _ : state) {
    const Stopwatch before;
    model->advance(maple.config.dt, motion.positions);
    advance += before.seconds();
    const Stopwatch watch;
    const StepReport report = integrator.step(motion, maple.config.dt);
    state.SetIterationTime(watch.seconds());
    if (!report.converged) return state.SkipWithError(report.reason.c_str());
    newton += report.newton;
    linear += report.linear;
  }
  const auto steps = static_cast<double>(state.iterations());
  state.counters["springs"] = maple.leaf.mesh.num_edges();
  state.counters["advance_seconds"] = advance / steps;
  state.counters["newton"] = newton / steps;
  state.counters["linear"] = linear / steps;
}

#define WILT_MODEL(name, model, vertices, steps) \
  BENCHMARK_CAPTURE(model_step, name, model, vertices)->Iterations(steps)->UseManualTime()
WILT_MODEL(cell_2k, "cell", 2000, 100);
WILT_MODEL(cell_5k, "cell", 5000, 50);
WILT_MODEL(cell_10k, "cell", 10000, 50);
WILT_MODEL(paper_2k, "paper", 2000, 100);

void metrics(benchmark::State& state) {
  const Maple maple(2000, "cell");
  std::vector<VertexId> tips;
  for (const Tip& tip : maple.venation.tips) tips.push_back(tip.vertex);
  const LeafMetrics measures(maple.leaf.mesh, maple.leaf.positions, maple.leaf.petiole, tips);
  const Points3 shape = maple.frames.back().positions;
  for (auto _ : state) benchmark::DoNotOptimize(measures.measure(shape, 100));
}
BENCHMARK(metrics)->UseRealTime()->Unit(benchmark::kMillisecond);

void texture(benchmark::State& state) {
  const Maple maple(2000, "cell");
  const Pigmentation& pigments = species("maple").pigments;
  const TissueColours tissue(pigments);
  const SenescencePattern pattern = senescence_pattern(maple.leaf, maple.venation, pigments);
  const auto texels = BladeTexels::make(maple.leaf, maple.venation, static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        leaf_texture(*texels, pattern, tissue, maple.frames.back().dryness, Vec3::Ones()));
}
BENCHMARK(texture)->Arg(1024)->UseRealTime()->Unit(benchmark::kMillisecond);

void relief(benchmark::State& state) {
  const Maple maple(2000, "cell");
  const auto texels = BladeTexels::make(maple.leaf, maple.venation, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(leaf_relief(*texels, maple.frames.back().dryness));
}
BENCHMARK(relief)->Arg(1024)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wilt::bench
