// Symbols: S working length, L leaf length, A blade area / L^2, l_w wrinkle length / L, l_ij rest length,
// l_ref mean edge length of a mesh of n_ref vertices, alpha_ij swelling area, eta differential strain.
#include "wilt/simulation/cell_model.hpp"

#include <algorithm>
#include <cmath>

#include "wilt/core/check.hpp"
#include "wilt/mechanics/area_limit.hpp"
#include "wilt/mechanics/edge_forces.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/simulation/model_parts.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/simulation/smooth_noise.hpp"
#include "wilt/water/dehydration.hpp"
#include "wilt/water/initial_mass.hpp"

namespace wilt {
namespace {

constexpr double kVeinReach = 0.05;   // distance over which the lamina loses touch with its vein, / L
constexpr double kMarginPower = 1.5;  // how late towards the margin the shrinking sets in
constexpr double kOnVein = 0.6;       // a vertex this near, in mean edges, lies on a vein

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

// The wrinkle length l_w / L.
double wrinkle_length(const ModelInput& input) {
  const double area = surface_area(input.leaf.mesh, input.rest) / (kWorkingLength * kWorkingLength);
  return input.config.bending.wrinkle_length * std::sqrt(area);
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

// k_b, with the hinges across veins stiffer: those whose far corners lie on one resist its bending, while the
// lamina may still fold along it.
Eigen::VectorXd bending_stiffness(const ModelInput& input, const Stencil& hinges) {
  const double k_b = input.config.bending.stiffness * std::pow(kWorkingLength / 5.0, 2.0) *
                     std::pow(wrinkle_length(input) / 0.15, 2.0);
  const auto on_vein = on_veins(input);
  Eigen::VectorXd stiffness(hinges.rows());
  for (int h = 0; h < hinges.rows(); ++h) {
    const bool across = on_vein[hinges(h, 2)] && on_vein[hinges(h, 3)];
    stiffness[h] = k_b * (across ? input.config.bending.vein_factor : 1.0);
  }
  return stiffness;
}

}  // namespace

Eigen::VectorXd differential_strain(const ModelInput& input) {
  const auto& c = input.config.shrinkage;
  const double length = kWorkingLength / input.scale;
  const Eigen::VectorXd& gd = input.venation.primary_distance;
  const Eigen::VectorXd& d_v = input.venation.vein_distance;
  const Eigen::VectorXd xi =
      smooth_noise(input.leaf.positions.leftCols<2>() / length, wrinkle_length(input),
                   static_cast<std::uint64_t>(input.config.seed), "differential strain");
  Eigen::VectorXd eta(gd.size());
  for (int i = 0; i < eta.size(); ++i) {
    const double gap = std::clamp(d_v[i] / length / kVeinReach, 0.0, 1.0);
    eta[i] = c.amount * (-c.vein_gap * gap * gap - c.margin * std::pow(gd[i] / gd.maxCoeff(), kMarginPower) +
                         c.noise * xi[i]);
  }
  return eta;
}

CellModel::CellModel(const ModelInput& input)
    : edges_(input.leaf.mesh.edge_matrix()),
      resolution_(resolution(input)),
      water_(input.config, WaterForm::conservative, cell_mass(input), loss_rate(input), resolution_, edges_,
             rest_lengths(input.leaf.mesh, input.rest)),
      external_(make_external_force(input, resolution_)),
      system_(water_.mass(), pinned_vertices(input)),
      droop_(input, water_.mass()),
      swelling_area_(swelling_areas(input, rest_lengths(input.leaf.mesh, input.rest))),
      swelling_weight_(differential_strain(input)),
      hinges_(hinge_stencil(input.leaf.mesh.face_matrix())),
      bending_turgor_loss_(input.config.bending.turgor_loss) {
  fresh_bending_ = bending_stiffness(input, hinges_);
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

void CellModel::update_swelling() {
  const Eigen::VectorXd weighted = swelling_weight_.cwiseProduct(water_.pressure_drop());
  Eigen::VectorXd c(edges_.rows());
  for (int e = 0; e < edges_.rows(); ++e)
    c[e] = swelling_area_[e] * 0.5 * (weighted[edges_(e, 0)] + weighted[edges_(e, 1)]);
  swelling_->set_coefficients(c);
}

void CellModel::update_bending() {
  const Eigen::VectorXd dryness = water_.dryness();
  Eigen::VectorXd stiffness(hinges_.rows());
  for (int h = 0; h < hinges_.rows(); ++h) {
    const double dry = 0.5 * (dryness[hinges_(h, 0)] + dryness[hinges_(h, 1)]);
    stiffness[h] = fresh_bending_[h] * (1.0 - bending_turgor_loss_ * dry);
  }
  bending_->set_stiffness(stiffness);
}

ForceBreakdown CellModel::forces(const Points3& x, const Points3& v) const {
  return {system_.force_of("elastic", x, v) + system_.force_of("strain limit", x, v) +
              system_.force_of("area limit", x, v),
          system_.force_of("damping", x, v), system_.force_of("swelling", x, v),
          system_.force_of("external", x, v)};
}

}  // namespace wilt
