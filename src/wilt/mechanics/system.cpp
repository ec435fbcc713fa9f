#include "wilt/mechanics/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/mechanics/argument_checks.hpp"

namespace wilt {
namespace {

double free_norm(const Points3& values, const std::vector<char>& pinned) {
  double sum = 0.0;
  for (int i = 0; i < values.rows(); ++i) {
    if (!pinned[i]) sum += values.row(i).squaredNorm();
  }
  return std::sqrt(sum);
}

bool same_edges(const Stencil& a, const Stencil& b) {
  return a.rows() == b.rows() && a == b;
}

}  // namespace

System::System(const Eigen::VectorXd& masses, std::vector<char> pinned) : pinned_(std::move(pinned)) {
  masses_.resize(masses.size());
  if (pinned_.size() != static_cast<std::size_t>(masses.size()))
    throw Error(ErrorCode::configuration,
                fmt::format("{} flags of pinned vertices for {} masses; give one per vertex", pinned_.size(),
                            masses.size()));
  set_masses(masses);
}

void System::set_masses(const Eigen::VectorXd& masses) {
  detail::require_count("masses", masses.size(), masses_.size());
  detail::require_values("the mass of vertex", masses, 0.0, true);
  masses_ = masses;
}

std::shared_ptr<const BlockPattern> System::make_pattern() {
  std::vector<Stencil> stencils;
  for (const auto& [name, energy] : energies_) stencils.push_back(energy->stencil());
  for (const auto& [name, force] : forces_) stencils.push_back(force->stencil());
  const auto pattern = std::make_shared<const BlockPattern>(vertex_count(), stencils);
  for (const auto& [name, energy] : energies_) energy->bind(*pattern);
  for (const auto& [name, force] : forces_) force->bind(*pattern);
  if (edge_law() != nullptr) springs_->stiffness.emplace(springs_->terms.front()->stencil(), *pattern);
  return pattern;
}

const EdgeLaw* System::edge_law() const {
  if (!springs_) find_edge_laws();
  if (springs_->terms.empty()) return nullptr;
  for (const EdgeLaw::Part part : {EdgeLaw::Part::stiffness, EdgeLaw::Part::push}) {
    int revision = 0;
    for (const Term* term : springs_->terms) revision += term->revision(part);
    int& known = springs_->law.revisions[static_cast<int>(part)];
    if (known == revision) continue;
    known = revision;
    springs_->law.set_zero(static_cast<int>(springs_->terms.front()->stencil().rows()), part);
    for (const Term* term : springs_->terms) term->add_edge_law(springs_->law, part);
  }
  return &springs_->law;
}

const SpringNetwork* System::springs() const {
  const EdgeLaw* law = edge_law();
  if (law == nullptr) return nullptr;
  if (!springs_->network) springs_->network.emplace(vertex_count(), springs_->terms.front()->stencil());
  springs_->network->set_law(*law);
  return &*springs_->network;
}

// The terms that are laws along the edges of the first of them.
void System::find_edge_laws() const {
  springs_.emplace();
  std::vector<const Term*> terms;
  for (const auto& [name, energy] : energies_) terms.push_back(energy.get());
  for (const auto& [name, force] : forces_) terms.push_back(force.get());
  for (const Term* term : terms) {
    const Stencil& stencil = term->stencil();
    if (stencil.cols() != 2) continue;
    EdgeLaw law;
    law.set_zero(static_cast<int>(stencil.rows()), EdgeLaw::Part::push);
    if (!term->add_edge_law(law, EdgeLaw::Part::push)) continue;
    if (springs_->terms.empty() || same_edges(stencil, springs_->terms.front()->stencil()))
      springs_->terms.push_back(term);
  }
}

bool System::in_springs(const Term& term) const {
  return springs_ &&
         std::find(springs_->terms.begin(), springs_->terms.end(), &term) != springs_->terms.end();
}

bool System::only_springs_and_loads() const {
  if (edge_law() == nullptr) return false;
  const auto fits = [&](const auto& named) { return named.second->is_load() || in_springs(*named.second); };
  return std::all_of(energies_.begin(), energies_.end(), fits) &&
         std::all_of(forces_.begin(), forces_.end(), fits);
}

void System::loads(const Points3& x, Points3& sum) const {
  sum.setZero(vertex_count(), 3);
  for (const auto& [name, energy] : energies_) {
    if (energy->is_load()) energy->add_gradient(x, sum);
  }
  sum = -sum;
  for (const auto& [name, force] : forces_) {
    if (force->is_load()) force->add_force(x, x, sum);
  }
}

double System::total_force(const Points3& x, const Points3& v, Points3& force) const {
  double scale = 0.0;
  Points3 term(x.rows(), 3);
  force.setZero(x.rows(), 3);
  if (const SpringNetwork* network = springs()) {
    network->add_force(x, v, force);
    scale = free_norm(force, pinned_);
  }
  for (const auto& [name, energy] : energies_) {
    if (in_springs(*energy)) continue;
    term.setZero();
    energy->add_gradient(x, term);
    force -= term;
    scale = std::max(scale, free_norm(term, pinned_));
  }
  for (const auto& [name, other] : forces_) {
    if (in_springs(*other)) continue;
    term.setZero();
    other->add_force(x, v, term);
    force += term;
    scale = std::max(scale, free_norm(term, pinned_));
  }
  return scale;
}

Points3 System::force_of(const std::string& name, const Points3& x, const Points3& v) const {
  Points3 force = Points3::Zero(x.rows(), 3);
  std::vector<std::string> names;
  for (const auto& [other, energy] : energies_) {
    names.push_back(other);
    if (other != name) continue;
    energy->add_gradient(x, force);
    return -force;
  }
  for (const auto& [other, term] : forces_) {
    names.push_back(other);
    if (other != name) continue;
    term->add_force(x, v, force);
    return force;
  }
  throw Error(ErrorCode::configuration, fmt::format("there is no force called '{}'; there are: {}{}", name,
                                                    fmt::join(names, ", "), did_you_mean(name, names)));
}

std::vector<std::pair<std::string, double>> System::energies(const Points3& x) const {
  std::vector<std::pair<std::string, double>> values;
  for (const auto& [name, energy] : energies_) values.emplace_back(name, energy->energy(x));
  return values;
}

double System::kinetic_energy(const Points3& v) const {
  double sum = 0.0;
  for (int i = 0; i < v.rows(); ++i) sum += 0.5 * masses_[i] * v.row(i).squaredNorm();
  return sum;
}

void System::assemble(const Points3& x, const Points3& v, double position_scale, double velocity_scale,
                      Curvature curvature, BlockMatrix& matrix) const {
  matrix.set_zero();
  for (int i = 0; i < vertex_count(); ++i) matrix.add_diagonal(i, masses_[i]);
  if (const EdgeLaw* law = edge_law())
    springs_->stiffness->add(*law, x, position_scale, velocity_scale, curvature, matrix);
  for (const auto& [name, energy] : energies_) {
    if (!in_springs(*energy)) energy->add_hessian(x, matrix, position_scale, curvature);
  }
  for (const auto& [name, force] : forces_) {
    if (!in_springs(*force)) force->add_jacobian(x, v, matrix, position_scale, velocity_scale, curvature);
  }
}

}  // namespace wilt
