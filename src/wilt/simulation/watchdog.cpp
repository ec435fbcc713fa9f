#include "wilt/simulation/watchdog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wilt/simulation/simulate.hpp"

namespace wilt {
namespace {

// dt x the velocities' root mean square over the mass, less their mean, in leaf lengths.
double relative_motion(double kinetic, const Points3& v, const Eigen::VectorXd& masses, double dt) {
  const double mass = masses.sum();
  const double mean = (v.transpose() * masses).squaredNorm() / (mass * mass);
  return dt * std::sqrt(std::max(0.0, 2.0 * kinetic / mass - mean)) / kWorkingLength;
}

}  // namespace

std::string Watchdog::complaint(const StepRow& row, double max_strain, const Points3& v,
                                const Eigen::VectorXd& masses) const {
  for (const auto& [name, value] : {std::pair("kinetic energy", row.kinetic),
                                    {"elastic energy", row.elastic},
                                    {"bending energy", row.bending},
                                    {"water", row.water}}) {
    if (!(value >= 0.0) || !std::isfinite(value))
      return fmt::format("the {} of the leaf is {}; take a smaller dt or weaker forces", name, value);
  }
  if (!(row.residual <= tolerance_ * (1.0 + 1e-9)))  // round-off of the quotient
    return fmt::format("a residual of {:.3g} passed for converged; solver.tolerance is {:.3g}", row.residual,
                       tolerance_);
  // Of the two ways to be strained, a length cannot be shortened by more than itself.
  if (const double stretch = 1.0 + max_strain; !(stretch <= kLargestStretch))
    return fmt::format(
        "an edge has {:.3g} times its rest length, more than {:g}; no leaf stretches so: weaken "
        "swelling and external forces or stiffen the springs",
        stretch, kLargestStretch);
  if (const double motion = relative_motion(row.kinetic, v, masses, dt_); !(motion <= kLargestMotion))
    return fmt::format(
        "the leaf moves by {:.3g} of its length in one step, more than {:g}; take a smaller dt or "
        "weaker forces",
        motion, kLargestMotion);
  return {};
}

}  // namespace wilt
