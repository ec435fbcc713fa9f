// The dihedral angle of a hinge with its first derivatives (internal).
//
//          left (2)            e = x1 - x0;  N_A, N_B area normals of the two triangles (0 1 2) and (1 0 3)
//         /   \                theta = atan2((N_A x N_B) . e/|e|, N_A . N_B)
//   (0)  ----e---- (1)         d theta/dx2 = -|e| N_A/|N_A|^2,  d theta/dx3 = -|e| N_B/|N_B|^2,
//         \   /                and on the edge's ends so that neither a translation nor a rotation changes
//         it:
//          right (3)           d theta/dx0 = -sum (1 - t) g,  d theta/dx1 = -sum t g,  t the foot of the
//          height.
#pragma once

#include <Eigen/Core>
#include <array>

#include "wilt/core/types.hpp"

namespace wilt::detail {

struct HingeDerivatives {
  bool flat_triangle = false;  ///< a triangle without area: the angle means nothing, all else is 0
  double angle = 0.0;
  std::array<Vec3, 4> gradient{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

HingeDerivatives hinge_derivatives(const std::array<Vec3, 4>& x);

}  // namespace wilt::detail
