// Symbols: gd distance to the nearest vein, gd_max its maximum, m_min, m_max, tau as in the paper,
// section 4.2.
#include "wilt/water/initial_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

double mass_at(int cell, double gd, double gd_max, const MassOptions& options) {
  // Distances come from sums of edge crossings: a last place beyond the maximum is the maximum.
  if (!(gd >= 0.0) || !(gd <= gd_max * (1.0 + 1e-12)))
    throw Error(ErrorCode::input,
                fmt::format("the distance of cell {} to its vein is {}, outside [0, {}]; give the "
                            "largest distance as gd_max",
                            cell, gd, gd_max));
  const double nearness = gd_max > 0.0 ? std::max(0.0, 1.0 - gd / gd_max) : 1.0;
  const double f = std::pow(nearness, options.tau);
  return options.m_min * (1.0 - f) + options.m_max * f;
}

}  // namespace

void MassOptions::validate() const {
  if (!(m_min > 0.0) || !(m_max >= m_min) || !std::isfinite(m_max))
    throw Error(ErrorCode::configuration,
                fmt::format("the masses are m_min = {} and m_max = {}; they must satisfy 0 < m_min <= m_max",
                            m_min, m_max));
  if (!(tau > 0.0) || !(tau <= 1.0))
    throw Error(ErrorCode::configuration,
                fmt::format("tau is {}; it must be above 0 and at most 1 (1 falls linearly)", tau));
}

Eigen::VectorXd initial_mass(const Eigen::VectorXd& gd, double gd_max, const MassOptions& options) {
  if (!(gd_max > 0.0) || !std::isfinite(gd_max))
    throw Error(ErrorCode::input,
                fmt::format("gd_max is {}; it must be the largest distance of any cell to a "
                            "vein, above 0",
                            gd_max));
  return initial_mass(gd, Eigen::VectorXd::Constant(gd.size(), gd_max), options);
}

Eigen::VectorXd initial_mass(const Eigen::VectorXd& gd, const Eigen::VectorXd& gd_max,
                             const MassOptions& options) {
  options.validate();
  if (gd.size() != gd_max.size())
    throw Error(ErrorCode::input,
                fmt::format("{} distances but {} maxima; give one per cell", gd.size(), gd_max.size()));
  Eigen::VectorXd masses(gd.size());
  for (int i = 0; i < gd.size(); ++i) masses[i] = mass_at(i, gd[i], gd_max[i], options);
  return masses;
}

}  // namespace wilt
