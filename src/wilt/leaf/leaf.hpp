// A leaf at rest: what every later stage works on.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "wilt/core/image.hpp"
#include "wilt/core/types.hpp"
#include "wilt/mesh/surface_mesh.hpp"

namespace wilt {

/// The petiole (stalk) as a centreline with a radius, from the blade outwards; empty when there is none.
struct Stalk {
  Points3 centreline;         ///< #K x 3, metres, leaf frame; the first point is the petiole vertex
  std::vector<double> radii;  ///< #K, metres
};

/// The blade as files show it: vertices are split where texture coordinates jump.
struct Skin {
  std::vector<VertexId> vertex;  ///< #S, the blade vertex of each skin vertex
  Points2 uv;                    ///< #S x 2, glTF convention: origin top left
  Faces faces;                   ///< #F x 3, in skin vertices, in the order of the mesh's faces
};

/// Coordinates of the file that a leaf came from = scale * rotation * (leaf frame) + translation, Z up.
struct Placement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();
  double scale = 1.0;
};

/// The part of a photo that texture coordinates 0 to 1 span: pixel = origin + uv * size.
struct PhotoArea {
  Vec2 origin = Vec2::Zero();
  Vec2 size = Vec2::Zero();  ///< pixels
};

/// How much each place of a photo looks like a vein: contrast of a line through it, from 0 to 1, which the
/// strongest tenth share; -1 where there is no blade. `size` x `size` texels over texture coordinates 0 to 1.
struct RidgeMap {
  int size = 0;
  std::vector<float> strength;  ///< rows from the top
};

/// What a photo shows of a leaf.
struct LeafPhoto {
  Image image;  ///< of the area, whose texels it fills; the blade's colours are carried on beyond its margin
  PhotoArea area;     ///< of the photo that was given
  RidgeMap ridges{};  ///< empty: none were looked for
};

/// A leaf blade with its petiole.
///
/// Leaf frame: the petiole vertex at the origin, x to the right, y towards the apex, z out of the upper
/// (adaxial) face; metres.
struct Leaf {
  std::string name;     ///< "maple", or the stem of the file's name
  std::string species;  ///< the preset whose parameters apply; "generic" for a foreign leaf
  std::uint64_t seed = 1;
  SurfaceMesh mesh;
  Points3 positions;  ///< #V x 3, metres
  VertexId petiole;   ///< where the stalk meets the blade, on the margin
  Stalk stalk;
  Skin skin;
  Placement placement;
  std::shared_ptr<const LeafPhoto> photo;  ///< of the fresh leaf, in the skin's texture coordinates; or none
  std::vector<std::string> notes;          ///< what was found, assumed or repaired; shown to the user
};

/// Distance from the petiole vertex to the farthest vertex, metres.
double leaf_length(const Leaf& leaf);

/// A skin without seams whose texture coordinates are the x and y of the blade's bounding box, y downwards,
/// with one scale for both axes and a margin of 1/64.
Skin planar_skin(const SurfaceMesh& mesh, const Points3& positions);

}  // namespace wilt
