// One small case of a hot path under callgrind: `valgrind --tool=callgrind --instr-atstart=no bench_guard
// CASE`. Only what stands in `counted` is counted; one thread, fixed work.
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include "bench/maple.hpp"
#include "bench/spring_system.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/embedding/embedding.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"
#include "wilt/mechanics/implicit_midpoint.hpp"
#include "wilt/output/gltf.hpp"
#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/simulate.hpp"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#endif

namespace wilt::bench {
namespace {

template <class Work>
void counted(const Work& work) {
  CALLGRIND_START_INSTRUMENTATION;
  work();
  CALLGRIND_STOP_INSTRUMENTATION;
}

// The fifth step: the first ones start from rest.
void spring_step(double stiffness) {
  const SpringProblem problem = spring_problem(1000, stiffness);
  SpringSystem springs(problem);
  ImplicitMidpoint integrator(springs.system());
  MotionState motion;
  motion.positions = problem.positions;
  for (int step = 0; step < 4; ++step) {
    springs.set_rest_lengths(problem.rest_lengths(step));
    integrator.step(motion, problem.dt);
  }
  springs.set_rest_lengths(problem.rest_lengths(4));
  counted([&] { integrator.step(motion, problem.dt); });
}

void default_step() {
  const Maple maple(500, "cell");
  const double scale = kWorkingLength / leaf_length(maple.leaf);
  MotionState motion;
  motion.positions = scale * maple.leaf.positions;
  const auto model = make_model({maple.leaf, maple.venation, maple.config, scale, motion.positions});
  ImplicitMidpoint integrator(model->system());
  const auto step = [&] {
    model->advance(maple.config.dt, motion.positions);
    integrator.step(motion, maple.config.dt);
  };
  for (int k = 0; k < 4; ++k) step();
  counted(step);
}

template <class Geodesics>
void distances_from_one() {
  const Surface surface = leaf_surface(1000);
  const Geodesics geodesics(surface.mesh, surface.positions);
  counted([&] { geodesics.distances(VertexId(0)); });
}

void smacof_iterations() {
  const Surface surface = leaf_surface(300);
  const Eigen::MatrixXd distances = all_pairs(surface.mesh, surface.positions, GeodesicMethod::fast);
  const Points2 start = classical_mds(distances).coordinates;
  counted([&] { smacof(distances, start, {10, 1e-300}); });
}

void leaf_mesh() {
  counted([] { make_leaf("maple", 500, 1); });
}

void glb_write() {
  const Maple maple(500, "paper");
  Clip clip{maple.leaf, maple.frames, &maple.venation};
  clip.colours.assign(maple.frames.size(), Points3::Constant(maple.leaf.positions.rows(), 3, 0.5));
  counted([&] { glb_bytes(clip); });
}

const std::map<std::string, std::function<void()>> kCases{
    {"spring_step", [] { spring_step(4.0); }},
    {"stiff_spring_step", [] { spring_step(1000.0); }},
    {"default_step", default_step},
    {"fast_geodesics", distances_from_one<FastGeodesics>},
    {"exact_geodesics", distances_from_one<ExactGeodesics>},
    {"smacof", smacof_iterations},
    {"make_leaf", leaf_mesh},
    {"glb_write", glb_write},
};

}  // namespace
}  // namespace wilt::bench

// Without an argument: what it was built with, then the cases, a line each.
int main(int argument_count, char** arguments) {
  using wilt::bench::kCases;
  if (argument_count == 1) {
    std::puts(WILT_BUILT_WITH);
    for (const auto& [name, run] : kCases) std::puts(name.c_str());
    return 0;
  }
  const auto found = kCases.find(arguments[1]);
  if (found == kCases.end()) return 2;
  const wilt::ThreadLimit one(1);
  found->second();
  return 0;
}
