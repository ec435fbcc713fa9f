// The mass of each cell at the start, heavier near the veins.
#pragma once

#include <Eigen/Core>

namespace wilt {

/// The range of masses and how it falls off with the distance from a vein.
struct MassOptions {
  double m_min = 0.7;  ///< at gd = gd_max, working mass, > 0
  double m_max = 1.5;  ///< on a vein, >= m_min
  double tau = 1.0;    ///< (0, 1]; 1 falls linearly, small values keep m_max nearly everywhere

  void validate() const;  ///< throws Error{configuration}
};

/// m_i = m_min (1 - f_i) + m_max f_i, f_i = (1 - gd_i / gd_max)^tau (the paper, section 4.2).
///
/// `gd` (#V): geodesic distance to the nearest vein, >= 0. `gd_max`: the largest of them over the whole leaf,
/// one number > 0. Throws Error{configuration} for bad options, Error{input} for a distance outside [0,
/// gd_max].
Eigen::VectorXd initial_mass(const Eigen::VectorXd& gd, double gd_max, const MassOptions& options);

/// The printed form: gd_max per vertex (#V), the farthest cell of that vertex's own vein. A vertex whose
/// gd_max is 0 lies on a vein that has no other cell and takes m_max.
Eigen::VectorXd initial_mass(const Eigen::VectorXd& gd, const Eigen::VectorXd& gd_max,
                             const MassOptions& options);

}  // namespace wilt
