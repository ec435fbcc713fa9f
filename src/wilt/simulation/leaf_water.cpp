#include "wilt/simulation/leaf_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

// Permeation::printed_number up to which the printed form is used. Beyond 1 it is unstable, but slowly so:
// 100 iterations of the maple still run at 3.4, the willow's stop at 5.3.
constexpr double kLargestNumber = 4.0;

// Working pressure. Default runs reach 2; at this one every spring has long snapped.
constexpr double kLargestPressure = 1e12;

// What goes missing in a step and is still round-off, of the leaf's water and what the air asked for.
constexpr double kRoundOff = 1e-9;

// Cells that begin with hardly more than the least there is may still lose nine tenths of it.
PermeationOptions permeation_options(const Config& config, double scale, double driest) {
  PermeationOptions options;
  options.lambda = config.water.diffusion;
  options.min_water = std::min(scale * options.min_water, 0.1 * driest);
  options.tolerance = 1e-10;  // of a step of motion: 1e-8; the total is kept whatever this is
  return options;
}

PressureOptions pressure_options(const Config& config, WaterForm form) {
  PressureOptions options;
  options.cell_constant = config.pressure.cell_constant;
  options.poisson_ratio = config.pressure.poisson_ratio;
  options.form = form == WaterForm::printed ? PressureForm::printed : PressureForm::rate;
  return options;
}

}  // namespace

LeafWater::LeafWater(const Config& config, WaterForm form, const Eigen::VectorXd& mass,
                     const Eigen::VectorXd& loss, double scale, const Edges& edges,
                     const Eigen::VectorXd& rest_lengths)
    : form_(form),
      dryness_scale_(config.water.dryness_scale),
      permeation_(static_cast<int>(mass.size()), edges, rest_lengths,
                  permeation_options(config, scale, config.mass.water_fraction * mass.minCoeff())),
      dry_((1.0 - config.mass.water_fraction) * mass),
      water_(config.mass.water_fraction * mass),
      first_water_(water_),
      pressure_(Eigen::VectorXd::Zero(mass.size())) {
  change(config, loss);
}

void LeafWater::change(const Config& config, const Eigen::VectorXd& loss) {
  pressure_options_ = pressure_options(config, form_);
  permeation_.set_lambda(config.water.diffusion);
  loss_ = loss;
  printed_permeation_ = form_ == WaterForm::printed &&
                        permeation_.printed_number(dry_, first_water_, config.dt) <= kLargestNumber;
}

void LeafWater::advance(double dt) {
  update_pressure(pressure_, water_, loss_, dt, pressure_options_);
  if (const double most = pressure_.cwiseAbs().maxCoeff(); !(most < kLargestPressure))
    throw Error(
        ErrorCode::simulation,
        fmt::format("the pressure in a cell has come to {:.3g}; the cells hold too little water for a loss "
                    "so fast: lower water.loss_rate or pressure.cell_constant",
                    most));
  if (printed_permeation_) {
    permeation_.printed_step(dry_, water_, loss_, dt);
    return;
  }
  const double before = water_.sum(), asked = dt * loss_.sum();
  const WaterReport report = permeation_.step(dry_, water_, loss_, dt);
  if (!report.converged)
    throw Error(
        ErrorCode::simulation,
        fmt::format("the permeation did not converge in {} iterations (residual {:.3g}); take a smaller dt "
                    "or water.diffusion",
                    report.iterations, report.residual));
  const double made = water_.sum() - before + report.lost, slack = kRoundOff * std::max(before, asked);
  if (!(std::abs(made) <= slack) || !(report.lost >= -slack))
    throw Error(
        ErrorCode::simulation,
        fmt::format("water is out of balance: {:.3g} before, {:.3g} after, {:.3g} lost to the air; take a "
                    "smaller dt or water.diffusion",
                    before, water_.sum(), report.lost));
}

void LeafWater::exchange_state(StateArchive& archive) {
  archive.matrix("water.water", water_);
  archive.matrix("water.pressure", pressure_);
}

Eigen::VectorXd LeafWater::dryness() const {
  return ((first_water_ - water_).cwiseQuotient(dryness_scale_ * first_water_)).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace wilt
