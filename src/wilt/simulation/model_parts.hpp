// What both models are put together from.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wilt/simulation/deformation_model.hpp"
#include "wilt/simulation/external_force.hpp"

namespace wilt {

/// Rest length of each edge of the mesh, #E, in the unit of `rest`.
Eigen::VectorXd rest_lengths(const SurfaceMesh& mesh, const Points3& rest);

/// The petiole and its one-ring as flags, #V; none when `config.pin` is "free".
std::vector<char> pinned_vertices(const ModelInput& input);

/// How fast each vertex loses water, #V: `rate`, and water.dry_factor times that within water.dry_region.
Eigen::VectorXd water_loss(const ModelInput& input, double rate);

/// The forces at the tips, in working units, times `factor`. Throws Error{configuration} when external.forces
/// are not as many as the tips.
ExternalForce make_external_force(const ModelInput& input, double factor);

/// For every vertex the distance (metres) of the farthest vertex that has the same nearest vein cell: gd_max
/// as printed. Nearest along edges; vein cells are vertices within half a mean edge of a primary vein.
Eigen::VectorXd farthest_of_vein_cell(const Leaf& leaf, const Venation& venation);

/// The forces of the terms of these names, #V x 3 each, evaluated at the same time.
std::vector<Points3> forces_of(const System& system, const std::vector<std::string>& names, const Points3& x,
                               const Points3& v);

}  // namespace wilt
