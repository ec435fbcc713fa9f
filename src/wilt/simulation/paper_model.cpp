#include "wilt/simulation/paper_model.hpp"

#include <utility>

#include "wilt/core/parallel.hpp"
#include "wilt/mechanics/edge_energies.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/model_parts.hpp"
#include "wilt/water/dehydration.hpp"
#include "wilt/water/initial_mass.hpp"

namespace wilt {
namespace {

Eigen::VectorXd printed_mass(const ModelInput& input) {
  const Config& c = input.config;
  return initial_mass(input.venation.primary_distance, farthest_of_vein_cell(input.leaf, input.venation),
                      MassOptions{c.mass.min, c.mass.max, c.mass.tau});
}

// c_ij = k_p alpha_ij dp_i for both directions of every edge: alpha_ij is the area of the triangle to the
// left of i -> j, or of the one triangle there is at the boundary.
Eigen::MatrixX2d swelling_coefficients(const SurfaceMesh& mesh, const FaceData<double>& areas,
                                       const Eigen::VectorXd& pressure_drop, double k_p) {
  Eigen::MatrixX2d c(mesh.num_edges(), 2);
  parallel_for(mesh.num_edges(), 4096, [&](int begin, int end) {
    for (EdgeId e(begin); e < end; e = EdgeId(e + 1)) {
      const HalfedgeId h = mesh.halfedge(e);
      const double left = areas[mesh.face(h)];
      const double right = mesh.is_boundary(e) ? left : areas[mesh.face(mesh.twin(h))];
      c.row(e) << k_p * left * pressure_drop[mesh.from(h)], k_p * right * pressure_drop[mesh.to(h)];
    }
  });
  return c;
}

}  // namespace

PaperModel::PaperModel(const ModelInput& input)
    : mesh_(input.leaf.mesh),
      swelling_(input.config.swelling.coefficient),
      stalk_(input.scale * input.leaf.stalk.centreline),
      water_(input.config, WaterForm::printed, printed_mass(input),
             water_loss(input, input.config.water.loss_rate), 1.0, mesh_.edge_matrix(),
             rest_lengths(mesh_, input.rest)),
      external_(make_external_force(input, 1.0)),
      system_(water_.mass(), pinned_vertices(input)) {
  const Edges edges = mesh_.edge_matrix();
  const Eigen::VectorXd lengths = rest_lengths(mesh_, input.rest);
  const auto constant = [&](double value) { return Eigen::VectorXd::Constant(edges.rows(), value); };
  const Config& c = input.config;
  system_.add_energy("elastic", std::make_unique<Springs>(edges, lengths, constant(c.springs.stiffness)));
  system_.add_force("damping", std::make_unique<EdgeDamping>(edges, constant(c.springs.damping)));
  swelling_force_ = &system_.add_force(
      "swelling", std::make_unique<OneSidedSwelling>(edges, Eigen::MatrixX2d::Zero(edges.rows(), 2)));
  external_force_ = &system_.add_force("external", std::make_unique<NodalForce>(external_.on_vertices()));
}

std::string PaperModel::note() const {
  return water_.printed_permeation() ? ""
                                     : "the printed permeation is unstable on a mesh as fine as this; the "
                                       "conservative one is used instead";
}

void PaperModel::advance(double dt, const Points3& x) {
  system_.set_masses(water_.mass());  // m^n in the step from n to n+1
  water_.advance(dt);
  external_.advance(dt);
  swelling_force_->set_coefficients(
      swelling_coefficients(mesh_, face_areas(mesh_, x), water_.pressure_drop(), swelling_));
  external_force_->set_values(external_.on_vertices());
}

void PaperModel::change_water(const ModelInput& input) {
  water_.change(input.config, water_loss(input, input.config.water.loss_rate));
}

void PaperModel::exchange_state(StateArchive& archive) {
  water_.exchange_state(archive);
  external_.exchange_state(archive);
}

ForceBreakdown PaperModel::forces(const Points3& x, const Points3& v) const {
  std::vector<Points3> f = forces_of(system_, {"elastic", "damping", "swelling", "external"}, x, v);
  return {std::move(f[0]), std::move(f[1]), std::move(f[2]), std::move(f[3])};
}

DeformationModel::Hanging PaperModel::hanging() const {
  Hanging hanging;
  hanging.stalk = stalk_;
  return hanging;
}

}  // namespace wilt
