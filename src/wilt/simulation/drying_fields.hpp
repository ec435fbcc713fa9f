// How unevenly a blade dries: what shrinks, folds, stiffens and rolls, as fields on its vertices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/simulation/deformation_model.hpp"

namespace wilt {

/// The wrinkle length l_w / L.
double wrinkle_length(const ModelInput& input);

/// docs/method.md, section 6, points 2 to 4. Tensors are symmetric, #V each; their part in the
/// surface at rest counts.
struct DryingFields {
  /// eta, #V: how strongly the swelling acts in every direction; negative: the tissue shrinks.
  Eigen::VectorXd strain;
  /// F: along the unit vector t the swelling gains t^T F t. It folds the lamina along its veins and crinkles
  /// the rim.
  std::vector<Eigen::Matrix3d> folds;
  /// B: bending across the unit vector n is stiffer by the factor 1 + n^T B n.
  std::vector<Eigen::Matrix3d> grain;
  /// K of the dry blade, 1 / working length; k d d^T rolls it up across d, towards the upper side for k > 0.
  std::vector<Eigen::Matrix3d> curvature;
};

/// O(#V log #V), deterministic; depends on the shape and the veins, not on the mesh.
DryingFields drying_fields(const ModelInput& input);

}  // namespace wilt
