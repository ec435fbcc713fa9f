// Symbols: S working length, L leaf length, A blade area / L^2, l_w wrinkle length / L, l_ij rest length,
// l_ref mean edge length of a mesh of n_ref vertices, alpha_ij swelling area, eta differential strain.
#include "wilt/simulation/cell_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wilt/core/check.hpp"
#include "wilt/mechanics/area_limit.hpp"
#include "wilt/mechanics/edge_forces.hpp"
#include "wilt/mechanics/spontaneous_curvature.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/drying_fields.hpp"
#include "wilt/simulation/model_parts.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/water/dehydration.hpp"
#include "wilt/water/initial_mass.hpp"

namespace wilt {
namespace {

constexpr double kOnVein = 0.6;  // a vertex this near, in mean edges, lies on a vein

double resolution(const ModelInput& input) {
  return static_cast<double>(input.config.reference.vertices) / input.leaf.mesh.num_vertices();
}

Eigen::VectorXd cell_mass(const ModelInput& input) {
  const Config& c = input.config;
  const Eigen::VectorXd& gd = input.venation.primary_distance;
  return resolution(input) * initial_mass(gd, gd.maxCoeff(), MassOptions{c.mass.min, c.mass.max, c.mass.tau});
}

double loss_rate(const ModelInput& input) {
  DehydrationOptions options;
  options.celsius = input.config.water.temperature_c;
  options.humidity = input.config.water.humidity;
  options.table_rate = input.config.water.loss_rate;
  return resolution(input) * dehydration_rate(options);
}

// k_p alpha_ij l_ref / l_ij: half the sum of the two rest triangles at each edge.
Eigen::VectorXd swelling_areas(const ModelInput& input, const Eigen::VectorXd& lengths) {
  const SurfaceMesh& mesh = input.leaf.mesh;
  const FaceData<double> areas = face_areas(mesh, input.rest);
  const double reference_length = lengths.mean() / std::sqrt(resolution(input));
  Eigen::VectorXd result(mesh.num_edges());
  for (const EdgeId e : mesh.edges()) {
    const HalfedgeId h = mesh.halfedge(e);
    const double both = areas[mesh.face(h)] + (mesh.is_boundary(e) ? 0.0 : areas[mesh.face(mesh.twin(h))]);
    result[e] = input.config.swelling.coefficient * 0.5 * both * reference_length / lengths[e];
  }
  return result;
}

// What the anisotropy of the shrinking adds to eta along each edge.
Eigen::VectorXd fold_weights(const ModelInput& input, const std::vector<Eigen::Matrix3d>& folds) {
  const SurfaceMesh& mesh = input.leaf.mesh;
  Eigen::VectorXd weights(mesh.num_edges());
  for (const EdgeId e : mesh.edges()) {
    const auto [a, b] = mesh.edge_vertices(e);
    const Vec3 t = (input.rest.row(b) - input.rest.row(a)).normalized().transpose();
    weights[e] = 0.5 * t.dot((folds[a] + folds[b]) * t);
  }
  return weights;
}

// Whether each vertex lies on a vein.
Eigen::Array<bool, Eigen::Dynamic, 1> on_veins(const ModelInput& input) {
  return input.venation.vein_distance.array() <
         kOnVein * mean_edge_length(input.leaf.mesh, input.leaf.positions);
}

// k_s, with the springs along veins stiffer.
Eigen::VectorXd spring_stiffness(const ModelInput& input) {
  const SurfaceMesh& mesh = input.leaf.mesh;
  const auto on_vein = on_veins(input);
  Eigen::VectorXd stiffness(mesh.num_edges());
  for (const EdgeId e : mesh.edges()) {
    const auto [a, b] = mesh.edge_vertices(e);
    const bool along = on_vein[a] && on_vein[b];
    stiffness[e] = input.config.springs.stiffness * (along ? input.config.springs.vein_factor : 1.0);
  }
  return stiffness;
}

// k_b with the grain, and with the hinges across veins stiffer: those whose far corners lie on one resist its
// bending, while the lamina may still fold along it.
Eigen::VectorXd bending_stiffness(const ModelInput& input, const Stencil& hinges,
                                  const std::vector<Eigen::Matrix3d>& grain) {
  const double k_b = input.config.bending.stiffness * std::pow(kWorkingLength / 5.0, 2.0) *
                     std::pow(wrinkle_length(input) / 0.15, 2.0);
  const auto on_vein = on_veins(input);
  const Eigen::VectorXd grain_across = across_hinges(hinges, input.rest, grain);
  Eigen::VectorXd stiffness(hinges.rows());
  for (int h = 0; h < hinges.rows(); ++h) {
    const bool across = on_vein[hinges(h, 2)] && on_vein[hinges(h, 3)];
    stiffness[h] = k_b * (1.0 + grain_across[h]) * (across ? input.config.bending.vein_factor : 1.0);
  }
  return stiffness;
}

}  // namespace

CellModel::CellModel(const ModelInput& input)
    : edges_(input.leaf.mesh.edge_matrix()),
      resolution_(resolution(input)),
      water_(input.config, WaterForm::conservative, cell_mass(input), water_loss(input, loss_rate(input)),
             resolution_, edges_, rest_lengths(input.leaf.mesh, input.rest)),
      external_(make_external_force(input, resolution_)),
      system_(water_.mass(), pinned_vertices(input)),
      droop_(input, water_.mass()),
      swelling_area_(swelling_areas(input, rest_lengths(input.leaf.mesh, input.rest))),
      hinges_(hinge_stencil(input.leaf.mesh.face_matrix())),
      bending_turgor_loss_(input.config.bending.turgor_loss) {
  const DryingFields fields = drying_fields(input);
  swelling_weight_ = fields.strain;
  fold_weight_ = fold_weights(input, fields.folds);
  fresh_bending_ = bending_stiffness(input, hinges_, fields.grain);
  // The two faces differ in one and the same swelling: without it there is no curvature either.
  drying_angles_ =
      input.config.swelling.coefficient * curvature_angles(hinges_, input.rest, fields.curvature);
  add_terms(input, rest_lengths(input.leaf.mesh, input.rest));
}

void CellModel::add_terms(const ModelInput& input, const Eigen::VectorXd& lengths) {
  const Config& c = input.config;
  const auto constant = [&](double value) { return Eigen::VectorXd::Constant(edges_.rows(), value); };
  const Eigen::VectorXd stiffness = spring_stiffness(input);
  system_.add_energy("elastic", std::make_unique<Springs>(edges_, lengths, stiffness));
  system_.add_energy("strain limit",
                     std::make_unique<StrainLimit>(edges_, lengths, c.strain_limit.stiffness * stiffness,
                                                   c.strain_limit.threshold));
  system_.add_energy(
      "area limit",
      std::make_unique<AreaLimit>(input.leaf.mesh.face_matrix(), input.rest,
                                  Eigen::VectorXd::Constant(input.leaf.mesh.num_faces(), c.springs.stiffness),
                                  c.strain_limit.area));
  swelling_ = &system_.add_energy("swelling", std::make_unique<LineTension>(edges_, constant(0.0)));
  bending_ = &system_.add_energy("bending", std::make_unique<Hinges>(hinges_, input.rest, fresh_bending_));
  fresh_angles_ = bending_->rest_angles();
  gravity_ = &system_.add_energy("gravity", std::make_unique<Gravity>(water_.mass(), droop_.gravity()));
  system_.add_force("damping", std::make_unique<EdgeDamping>(edges_, constant(c.springs.damping)));
  external_force_ = &system_.add_force("external", std::make_unique<NodalForce>(external_.on_vertices()));
}

void CellModel::advance(double dt, const Points3& x) {
  const Eigen::VectorXd mass = water_.mass();  // m^n in the step from n to n+1
  system_.set_masses(mass);
  water_.advance(dt);
  external_.advance(dt);
  droop_.advance(mass, 1.0 - water_.dryness().mean(), x);
  update_swelling();
  update_bending();
  gravity_->set_masses(mass);
  gravity_->set_acceleration(droop_.gravity());
  external_force_->set_values(external_.on_vertices());
}

void CellModel::change_water(const ModelInput& input) {
  water_.change(input.config, water_loss(input, loss_rate(input)));
}

void CellModel::exchange_state(StateArchive& archive) {
  water_.exchange_state(archive);
  external_.exchange_state(archive);
  droop_.exchange_state(archive);
}

void CellModel::update_swelling() {
  const Eigen::VectorXd dp = water_.pressure_drop();
  const Eigen::VectorXd weighted = swelling_weight_.cwiseProduct(dp);
  Eigen::VectorXd c(edges_.rows());
  for (int e = 0; e < edges_.rows(); ++e)
    c[e] = swelling_area_[e] * 0.5 *
           (weighted[edges_(e, 0)] + weighted[edges_(e, 1)] +
            fold_weight_[e] * (dp[edges_(e, 0)] + dp[edges_(e, 1)]));
  swelling_->set_coefficients(c);
}

void CellModel::update_bending() {
  const Eigen::VectorXd dryness = water_.dryness();
  Eigen::VectorXd stiffness(hinges_.rows()), angles(hinges_.rows());
  for (int h = 0; h < hinges_.rows(); ++h) {
    const double dry = 0.5 * (dryness[hinges_(h, 0)] + dryness[hinges_(h, 1)]);
    angles[h] = fresh_angles_[h] + dry * drying_angles_[h];
    stiffness[h] = fresh_bending_[h] * (1.0 - bending_turgor_loss_ * dry);
  }
  bending_->set_stiffness(stiffness);
  bending_->set_rest_angles(angles);
}

ForceBreakdown CellModel::forces(const Points3& x, const Points3& v) const {
  std::vector<Points3> f =
      forces_of(system_, {"elastic", "strain limit", "area limit", "damping", "swelling", "external"}, x, v);
  return {f[0] + f[1] + f[2], std::move(f[3]), std::move(f[4]), std::move(f[5])};
}

}  // namespace wilt
