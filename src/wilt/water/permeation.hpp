// Water moving from cell to cell, and leaving them.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "wilt/core/types.hpp"

namespace wilt {

struct PermeationOptions {
  double lambda = 0.1;       ///< diffusion coefficient of Table 1, >= 0
  double min_water = 1e-3;   ///< no cell falls below it, working mass, > 0
  double tolerance = 1e-13;  ///< residual of the linear system relative to its right-hand side, (0, 1)

  void validate() const;  ///< throws Error{configuration}
};

/// Where the water of one step went: sum(w_new) = sum(w_old) - lost, to round-off.
struct WaterReport {
  double lost = 0.0;      ///< left the leaf = sum(loss) dt - withheld
  double withheld = 0.0;  ///< asked for but not there: what the lower bound kept in the cells
  int dry_cells = 0;      ///< cells at the lower bound
  int iterations = 0;     ///< of the linear solver
  double residual = 0.0;  ///< reached, relative to the right-hand side
  bool converged = true;  ///< false: the linear solver stopped short of the tolerance
};

/// Equation 1 of the paper as the linear system it stands for, in a form that conserves water.
///
///     (I - dt L) w' = w - loss dt,   (L w)_i = (2/E) sum_j lambda (b_i w_j - b_j w_i) / (l_ij (m_i + m_j))
///
/// w water, b dry mass, m = w + b taken at the old time, l_ij rest length. In u = w/b with one E (the mean
/// over the vertices of the sum of incident rest lengths) it is symmetric positive definite:
///     b_i u_i - dt sum_j g_ij (u_j - u_i) = w_i - loss_i dt,   g_ij = 2 lambda b_i b_j / (E l_ij (m_i +
///     m_j)).
/// Solved by conjugate gradients from the old u; w' is then formed from the flows g_ij (u_j - u_i), which
/// cancel in pairs, so that the total is kept to round-off whatever the tolerance. O(#E) per iteration;
/// deterministic.
class Permeation {
 public:
  /// `edges` #E x 2 over `vertex_count` vertices, `rest_lengths` #E, > 0. Throws Error{input}, naming the
  /// edge.
  Permeation(int vertex_count, const Edges& edges, const Eigen::VectorXd& rest_lengths,
             const PermeationOptions& options = {});
  ~Permeation();
  Permeation(Permeation&&) noexcept;
  Permeation& operator=(Permeation&&) noexcept;

  /// Throws Error{configuration} below 0.
  void set_lambda(double lambda);

  /// One step of `dt` > 0. `dry` #V, > 0; `water` #V, >= 0, is replaced; `loss` #V, >= 0, mass per time.
  /// Throws Error{simulation} when a mass is not finite or dry <= 0; `water` is then untouched.
  WaterReport step(const Eigen::VectorXd& dry, Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                   double dt);

  /// The printed form: w_i' = (w_i - loss_i dt) / (1 - dt L_i), L_i the number
  /// (2/E_i) sum_j lambda (b_i w_j - b_j w_i) / (l_ij (m_i + m_j)), E_i the sum of the rest lengths at i.
  /// It does not conserve water: `lost` is still the true difference, `withheld` what the lower bound added.
  WaterReport printed_step(const Eigen::VectorXd& dry, Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                           double dt);

  /// The mean over the cells of dt u_i (2/E_i) sum_j lambda b_j / (l_ij (m_i + m_j)): by which share the
  /// printed form lets a cell's difference to its neighbours go in one step. It grows with the number of
  /// vertices; beyond 1 neighbours overshoot each other, as in any explicit step of diffusion.
  double printed_number(const Eigen::VectorXd& dry, const Eigen::VectorXd& water, double dt) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wilt
