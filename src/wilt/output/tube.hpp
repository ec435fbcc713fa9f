// A tube around a centreline: how a stalk is drawn.
#pragma once

#include <vector>

#include "wilt/core/types.hpp"

namespace wilt {

/// A closed surface of rings and two flat caps, whose corners are the caps' own.
struct Tube {
  Points3 positions;  ///< #T x 3: the rings from the first point on, then the two caps
  Points3 normals;    ///< #T x 3, unit, outwards
  Faces faces;        ///< counter-clockwise seen from outside; depends on #K and `sides` only
};

/// A direction across the start of the centreline (#K x 3) that stays across it while the stalk bends:
/// x or z of the leaf frame, whichever is farther from the first tangent.
Vec3 tube_reference(const Points3& centreline);

/// The tube around `centreline` (#K x 3, K >= 2) with `radii` (#K, > 0) and `sides` >= 3 corners per ring.
///
/// The ring frame starts along `reference` and is carried along by the smallest rotation from each tangent
/// to the next (parallel transport), so that the tube has no twist of its own, and the tubes of two bent
/// stalks with one reference correspond corner by corner. Throws std::logic_error for a wrong size.
Tube tube(const Points3& centreline, const std::vector<double>& radii, int sides, const Vec3& reference);

}  // namespace wilt
