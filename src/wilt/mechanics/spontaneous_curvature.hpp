// Rest angles of hinges on a sheet that wants to be curved: two layers that shrink unlike (Timoshenko 1925).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/mechanics/term.hpp"

namespace wilt {

/// What spontaneous curvature adds to the rest angle of every hinge, #H, radians: the angle that the four
/// corners, flat at first, take when they are lifted onto a surface of that curvature,
///
///   theta = -(K_nn (h1 + h2) + 2 K_tn (t1 - t2) + K_tt (t1 (t1 - l)/h1 + t2 (t2 - l)/h2)) / 2,
///
/// t along the edge of length l and n across it, h the height of each triangle and t1, t2 where it meets the
/// edge. So a cylinder's angles come out right on any triangulation, to the order of (K h)^2.
///
/// `hinges` #H x 4 as from hinge_stencil; `rest` #V x 3; `curvature` #V symmetric tensors, 1 / length, of
/// which the part in the surface counts: k d d^T rolls the sheet up about the axis across d, with radius 1/k,
/// towards the upper side (k > 0) or the lower. A hinge takes the mean of its edge's ends; no angle exceeds a
/// right one, a triangle without area gets none. Throws Error{configuration} for a wrong count.
Eigen::VectorXd curvature_angles(const Stencil& hinges, const Points3& rest,
                                 const std::vector<Eigen::Matrix3d>& curvature);

/// n^T T n of every hinge, #H, n the unit vector in the surface across the hinge's edge: how much of a tensor
/// T its bending feels. `tensors` #V, the mean of the edge's ends counts. Throws Error{configuration} for a
/// wrong count.
Eigen::VectorXd across_hinges(const Stencil& hinges, const Points3& rest,
                              const std::vector<Eigen::Matrix3d>& tensors);

}  // namespace wilt
