// A set of masses with the energies and forces that act on them.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/edge_stiffness.hpp"
#include "wilt/mechanics/spring_network.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// Where the vertices are and how fast they move; all #V x 3, working units.
struct MotionState {
  Points3 positions;
  Points3 velocities;     ///< empty: at rest
  Points3 accelerations;  ///< of the last step, where the next one starts its iteration; empty: zero
  Points3 jerks;          ///< how the last two steps' accelerations differ, per time; empty: zero

  /// Gives what is empty, or of another size, `vertex_count` rows of zeros; not the positions.
  void complete(int vertex_count) {
    for (Points3* history : {&velocities, &accelerations, &jerks}) {
      if (history->rows() != vertex_count) history->setZero(vertex_count, 3);
    }
  }
};

/// Masses, pinned vertices and named terms. Terms are owned here and changed between steps through the
/// references that add_energy and add_force return; these stay valid for the system's life, also when it is
/// moved.
class System {
 public:
  /// `masses` #V, > 0; `pinned` #V flags, vertices that keep the positions they have. Throws
  /// Error{configuration}.
  System(const Eigen::VectorXd& masses, std::vector<char> pinned);

  template <class E>
  E& add_energy(std::string name, std::unique_ptr<E> energy) {
    E& reference = *energy;
    energies_.emplace_back(std::move(name), std::move(energy));
    springs_.reset();
    return reference;
  }
  template <class F>
  F& add_force(std::string name, std::unique_ptr<F> force) {
    F& reference = *force;
    forces_.emplace_back(std::move(name), std::move(force));
    springs_.reset();
    return reference;
  }

  int vertex_count() const { return static_cast<int>(masses_.size()); }
  const Eigen::VectorXd& masses() const { return masses_; }
  void set_masses(const Eigen::VectorXd& masses);
  const std::vector<char>& pinned() const { return pinned_; }

  /// The pattern that all terms together need; binds every term to it.
  std::shared_ptr<const BlockPattern> make_pattern();

  /// The sum of all terms that are laws along one and the same set of edges, as they are now, ready to be
  /// evaluated; none when there are no such terms. Good until a term is added.
  const SpringNetwork* springs() const;

  /// Whether springs() and constant loads are all there is.
  bool only_springs_and_loads() const;

  /// sum = the constant loads, #V x 3; `x` any positions.
  void loads(const Points3& x, Points3& sum) const;

  /// force = the sum of all forces, #V x 3 (pinned vertices included: there it is minus the reaction).
  /// Returns the largest norm over the free vertices of any single term's force, the laws along edges taken
  /// as one: the scale to compare a residual with.
  double total_force(const Points3& x, const Points3& v, Points3& force) const;

  /// The force of the term of this name. Throws Error{configuration} when there is none.
  Points3 force_of(const std::string& name, const Points3& x, const Points3& v) const;

  /// Each energy's name and value.
  std::vector<std::pair<std::string, double>> energies(const Points3& x) const;
  double kinetic_energy(const Points3& v) const;

  /// matrix = M - position_scale dF/dx - velocity_scale dF/dv; its pattern is from make_pattern.
  void assemble(const Points3& x, const Points3& v, double position_scale, double velocity_scale,
                Curvature curvature, BlockMatrix& matrix) const;

 private:
  Eigen::VectorXd masses_;
  std::vector<char> pinned_;
  std::vector<std::pair<std::string, std::unique_ptr<Energy>>> energies_;
  std::vector<std::pair<std::string, std::unique_ptr<Force>>> forces_;

  // The laws along edges in one, made when first asked for and whenever a coefficient has changed since.
  struct Springs {
    std::optional<SpringNetwork> network;
    std::optional<detail::EdgeStiffness> stiffness;
    std::vector<const Term*> terms;
    EdgeLaw law;  // their sum; kept, since a step should not ask for memory
  };
  void find_edge_laws() const;
  const EdgeLaw* edge_law() const;
  bool in_springs(const Term& term) const;
  mutable std::optional<Springs> springs_;
};

}  // namespace wilt
