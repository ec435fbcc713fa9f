// The workload's springs as wilt's mechanics takes them.
#pragma once

#include <memory>

#include "bench/workload.hpp"
#include "wilt/mechanics/edge_energies.hpp"
#include "wilt/mechanics/edge_forces.hpp"
#include "wilt/mechanics/nodal_terms.hpp"
#include "wilt/mechanics/system.hpp"

namespace wilt::bench {

class SpringSystem {
 public:
  explicit SpringSystem(const SpringProblem& problem) : system_(problem.masses, problem.pinned) {
    const auto each = [&](double value) { return Eigen::VectorXd::Constant(problem.edge_count(), value); };
    springs_ = &system_.add_energy(
        "elastic", std::make_unique<Springs>(problem.edges, problem.first_rest, each(problem.stiffness)));
    system_.add_force("damping", std::make_unique<EdgeDamping>(problem.edges, each(problem.damping)));
    system_.add_energy("gravity",
                       std::make_unique<Gravity>(problem.masses, Vec3(0.0, 0.0, -problem.gravity)));
  }

  System& system() { return system_; }
  void set_rest_lengths(const Eigen::VectorXd& lengths) { springs_->set_rest_lengths(lengths); }

 private:
  System system_;
  Springs* springs_;
};

}  // namespace wilt::bench
