// The veins that are finer than a mesh: tertiary cells, the smaller ones within, areoles.
#pragma once

#include <cstdint>

#include "wilt/core/types.hpp"

namespace wilt {

/// Smooth noise in the plane with its gradient: cubic between random values in [-1, 1] on the integers.
struct Noise {
  double value = 0.0;
  Vec2 gradient = Vec2::Zero();
};
Noise value_noise(const Vec2& p, std::uint64_t seed);

/// Distance to the nearest wall between the cells of random points, one in each unit square (Worley 1996).
struct CellWall {
  double distance = 0.0;       ///< to the line half-way between the two nearest points
  Vec2 gradient = {0.0, 0.0};  ///< of the distance
};
CellWall cell_wall(const Vec2& p, std::uint64_t seed);

/// The network at a point. Heights are 1 on a vein's axis and 0 in the tissue.
struct FineNetwork {
  double tertiary = 0.0, quaternary = 0.0, areole = 0.0;
  double within = 0.0;  ///< distance to the nearest tertiary vein, in sizes of a tertiary cell
};

/// The network at `p`, x and y of the blade at rest in units of the leaf's length. Cells of about 1/22, 1/60
/// and 1/150 of the length; the finer veins fade in places, as veinlets end freely. A drawing with the looks
/// of a reticulate venation, not a model of its growth. Depends on position and seed alone.
FineNetwork fine_network(const Vec2& p, std::uint64_t seed);

}  // namespace wilt
