#include "wilt/simulation/regions.hpp"

#include <algorithm>
#include <array>

#include "wilt/core/parallel.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

constexpr std::array<Region, 4> kRegions = {Region::tip, Region::vein, Region::margin, Region::mesophyll};
constexpr int kBlock = 4096;  // vertices that are summed up by one thread

// Of each region (by its number): the sums of what a ForceRow holds, and how many vertices it has.
struct RegionSums {
  Eigen::Array<double, 6, 4> values = Eigen::Array<double, 6, 4>::Zero();
  std::array<int, 4> counts{};
};

}  // namespace

const char* region_name(Region region) {
  switch (region) {
    case Region::tip:
      return "tip";
    case Region::vein:
      return "vein";
    case Region::margin:
      return "margin";
    case Region::mesophyll:
      return "mesophyll";
  }
  return "";
}

VertexData<Region> leaf_regions(const Leaf& leaf, const Venation& venation) {
  const SurfaceMesh& mesh = leaf.mesh;
  const double near_vein = 0.5 * mean_edge_length(mesh, leaf.positions);
  VertexData<Region> regions(mesh.num_vertices(), Region::mesophyll);
  for (const VertexId v : mesh.vertices()) {
    if (venation.primary_distance[v] <= near_vein) {
      regions[v] = Region::vein;
    } else if (mesh.is_boundary(v)) {
      regions[v] = Region::margin;
    }
  }
  for (const Tip& tip : venation.tips) {
    regions[tip.vertex] = Region::tip;
    for (const VertexId v : mesh.one_ring(tip.vertex)) regions[v] = Region::tip;
  }
  return regions;
}

std::vector<ForceRow> force_rows(const VertexData<Region>& regions, const DeformationModel& model,
                                 const Points3& x, const Points3& v, int iteration) {
  const ForceBreakdown forces = model.forces(x, v);
  const Eigen::VectorXd &water = model.water(), &dry = model.dry_mass(), drop = model.pressure_drop();
  const int blocks = (regions.size() + kBlock - 1) / kBlock;
  std::vector<RegionSums> sums(static_cast<std::size_t>(blocks));
  parallel_for(blocks, 1, [&](int begin, int end) {
    for (int block = begin; block < end; ++block) {
      RegionSums& sum = sums[static_cast<std::size_t>(block)];
      for (int i = block * kBlock; i < std::min(regions.size(), (block + 1) * kBlock); ++i) {
        const auto region = static_cast<std::size_t>(regions[VertexId(i)]);
        ++sum.counts[region];
        sum.values.col(static_cast<Eigen::Index>(region)) +=
            (Eigen::Array<double, 6, 1>() << forces.elastic.row(i).norm(), forces.damping.row(i).norm(),
             forces.swelling.row(i).norm(), forces.external.row(i).norm(), water[i] / (water[i] + dry[i]),
             -drop[i])
                .finished();
      }
    }
  });
  RegionSums total;
  for (const RegionSums& sum : sums) {
    total.values += sum.values;
    for (std::size_t r = 0; r < kRegions.size(); ++r) total.counts[r] += sum.counts[r];
  }
  std::vector<ForceRow> rows;
  for (std::size_t r = 0; r < kRegions.size(); ++r) {
    if (total.counts[r] == 0) continue;
    const Eigen::Array<double, 6, 1> mean = total.values.col(static_cast<Eigen::Index>(r)) / total.counts[r];
    rows.push_back({iteration, kRegions[r], mean[0], mean[1], mean[2], mean[3], mean[4], mean[5]});
  }
  return rows;
}

}  // namespace wilt
