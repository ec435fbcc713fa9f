// The pressure inside a cell as it loses water.
#pragma once

#include <Eigen/Core>

namespace wilt {

enum class PressureForm {
  printed,  ///< p' = p - E_v loss / (w dt): the paper's, which depends on the step
  rate,     ///< p' = p - E_v loss dt / (w dt_ref^2): equal to it at dt = dt_ref, and converges as dt -> 0
};

struct PressureOptions {
  double cell_constant = 2e-4;   ///< c of Table 1, working pressure, >= 0
  double poisson_ratio = 0.499;  ///< mu of Table 1, [0, 0.5)
  double reference_step = 0.1;   ///< dt_ref, the paper's step, working time, > 0
  PressureForm form = PressureForm::rate;

  void validate() const;  ///< throws Error{configuration}
};

/// E_v = c / (1 - 2 mu), the elastic modulus of a cell.
double elastic_modulus(const PressureOptions& options);

/// Replaces `pressure` (#V) by its value after a step `dt` > 0 in which the cells, holding `water` (#V, > 0)
/// at its start, lost `loss` (#V, >= 0) per time. Throws Error{configuration} for bad options,
/// Error{simulation} for dry cells.
void update_pressure(Eigen::VectorXd& pressure, const Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                     double dt, const PressureOptions& options);

}  // namespace wilt
