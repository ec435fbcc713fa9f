// The numeric types that cross the rooms.
#pragma once

#include <Eigen/Core>

namespace wilt {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  ///< #V x 2
using Points3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< #V x 3
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;       ///< #F x 3, counter-clockwise
using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;       ///< #E x 2

}  // namespace wilt
