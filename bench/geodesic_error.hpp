// How far approximate distances are from exact ones; the same measure for wilt and its peers.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "bench/workload.hpp"
#include "wilt/geodesics/exact_geodesics.hpp"

namespace wilt::bench {

/// Counters "mean_error" and "largest_error", relative, over all vertices from ten sources.
/// `distances_from(VertexId)` gives #V distances.
template <class Distances>
void report_error(benchmark::State& state, const Surface& surface, const Distances& distances_from) {
  constexpr int kSources = 10;
  const ExactGeodesics exact(surface.mesh, surface.positions);
  double sum = 0.0, largest = 0.0;
  for (const VertexId source : spread_sources(surface.mesh, kSources)) {
    const Eigen::VectorXd reached = distances_from(source), wanted = exact.distances(source);
    for (int v = 0; v < wanted.size(); ++v) {
      if (v == source) continue;
      const double error = std::abs(reached[v] - wanted[v]) / wanted[v];
      sum += error;
      largest = std::max(largest, error);
    }
  }
  state.counters["mean_error"] = sum / kSources / (surface.mesh.num_vertices() - 1);
  state.counters["largest_error"] = largest;
}

}  // namespace wilt::bench
