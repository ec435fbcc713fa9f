// Symbols: p pressure, w water, E_v elastic modulus of a cell, c cell constant, mu Poisson's ratio (paper,
// section 4.4).
#include "wilt/water/pressure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt {

void PressureOptions::validate() const {
  if (!(cell_constant >= 0.0) || !std::isfinite(cell_constant))
    throw Error(ErrorCode::configuration,
                fmt::format("cell_constant (c) is {}; it must be 0 or more", cell_constant));
  if (!(poisson_ratio >= 0.0) || !(poisson_ratio < 0.5))
    throw Error(ErrorCode::configuration,
                fmt::format("poisson_ratio (mu) is {}; it must be at least 0 and below 0.5", poisson_ratio));
  if (!(reference_step > 0.0) || !std::isfinite(reference_step))
    throw Error(ErrorCode::configuration,
                fmt::format("reference_step is {}; it must be above 0", reference_step));
}

double elastic_modulus(const PressureOptions& options) {
  options.validate();
  return options.cell_constant / (1.0 - 2.0 * options.poisson_ratio);
}

void update_pressure(Eigen::VectorXd& pressure, const Eigen::VectorXd& water, const Eigen::VectorXd& loss,
                     double dt, const PressureOptions& options) {
  const double modulus = elastic_modulus(options);
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw Error(ErrorCode::configuration, fmt::format("the time step is {}; it must be above 0", dt));
  if (water.size() != pressure.size() || loss.size() != pressure.size())
    throw Error(ErrorCode::configuration,
                fmt::format("{} pressures, {} waters and {} losses; give one per cell", pressure.size(),
                            water.size(), loss.size()));
  const bool rate = options.form == PressureForm::rate;
  const double time = rate ? options.reference_step * options.reference_step / dt : dt;
  for (int i = 0; i < water.size(); ++i) {
    if (!(water[i] > 0.0))
      throw Error(ErrorCode::simulation,
                  fmt::format("cell {} holds {} water; the pressure needs more than 0, so "
                              "keep a lower bound on it",
                              i, water[i]));
  }
  for (int i = 0; i < water.size(); ++i) pressure[i] -= modulus * loss[i] / (water[i] * time);
}

}  // namespace wilt
