// The meshes of a GLB, frame by frame, in the coordinates of the file.
#pragma once

#include <functional>
#include <string>

#include "wilt/output/clip.hpp"

namespace wilt {

/// The positions and unit normals of a mesh at a frame, #S x 3, coordinates of the file.
struct Shape {
  Points3 positions, normals;
};

/// The blade at the vertices of its mesh, #V x 3.
Shape blade_shape(const Clip& clip, int frame);

/// A mesh to be written: what does not change, and its shape and linear colours (#S x 3) by frame.
struct Moving {
  std::string name;
  Faces faces;
  Points2 uv;             ///< or empty
  Points2 lookup;         ///< second texture coordinates, or empty
  Eigen::VectorXd water;  ///< or empty
  int colour_count = 0;   ///< 0, 1 or one per frame
  std::function<Shape(int frame)> shape;
  std::function<Points3(int frame)> colours;
};

/// The leaf's skin. Refers to the clip.
Moving moving_blade(const Clip& clip);

/// The stalk as a tube. Refers to the clip, whose frames have a stalk of two points or more.
Moving moving_stalk(const Clip& clip, int sides);

}  // namespace wilt
