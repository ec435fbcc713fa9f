#include "wilt/simulation/regions.hpp"

#include <array>

#include "wilt/mesh/geometry.hpp"

namespace wilt {
namespace {

constexpr std::array<Region, 4> kRegions = {Region::tip, Region::vein, Region::margin, Region::mesophyll};

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
  const Eigen::VectorXd fraction = model.water().cwiseQuotient(model.water() + model.dry_mass());
  std::vector<ForceRow> rows;
  for (const Region region : kRegions) {
    ForceRow row;
    row.iteration = iteration;
    row.region = region;
    int count = 0;
    for (int i = 0; i < regions.size(); ++i) {
      if (regions[VertexId(i)] != region) continue;
      ++count;
      row.elastic += forces.elastic.row(i).norm();
      row.damping += forces.damping.row(i).norm();
      row.swelling += forces.swelling.row(i).norm();
      row.external += forces.external.row(i).norm();
      row.water += fraction[i];
      row.pressure -= model.pressure_drop()[i];
    }
    if (count == 0) continue;
    for (double* mean : {&row.elastic, &row.damping, &row.swelling, &row.external, &row.water, &row.pressure})
      *mean /= count;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace wilt
