#include "wilt/simulation/leaf_water.hpp"

namespace wilt {
namespace {

PermeationOptions permeation_options(const Config& config, double scale) {
  PermeationOptions options;
  options.lambda = config.water.diffusion;
  options.min_water *= scale;
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

LeafWater::LeafWater(const Config& config, WaterForm form, const Eigen::VectorXd& mass, double loss,
                     double scale, const Edges& edges, const Eigen::VectorXd& rest_lengths)
    : form_(form),
      pressure_options_(pressure_options(config, form)),
      dryness_scale_(config.water.dryness_scale),
      permeation_(static_cast<int>(mass.size()), edges, rest_lengths, permeation_options(config, scale)),
      dry_((1.0 - config.mass.water_fraction) * mass),
      water_(config.mass.water_fraction * mass),
      first_water_(water_),
      loss_(Eigen::VectorXd::Constant(mass.size(), loss)),
      pressure_(Eigen::VectorXd::Zero(mass.size())) {}

void LeafWater::advance(double dt) {
  update_pressure(pressure_, water_, loss_, dt, pressure_options_);
  if (form_ == WaterForm::printed) {
    permeation_.printed_step(dry_, water_, loss_, dt);
  } else {
    permeation_.step(dry_, water_, loss_, dt);
  }
}

Eigen::VectorXd LeafWater::dryness() const {
  return ((first_water_ - water_).cwiseQuotient(dryness_scale_ * first_water_)).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace wilt
