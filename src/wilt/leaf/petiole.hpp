// Finding the petiole of a leaf that nobody labelled, and putting the leaf into its frame.
#pragma once

#include <string>

#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt {

/// A stalk drawn as part of an outline, cut off where it meets the blade.
struct StalkCut {
  Outline blade;                    ///< the outline without the stalk
  bool found = false;               ///< whether there was one
  Vec2 petiole;                     ///< where it met the blade (on the blade's margin), if found
  Points2 centreline;               ///< #K x 2, from the blade outwards, if found
  std::vector<double> half_widths;  ///< #K
};

/// Finds a thin appendage (narrower than a few percent of the blade and long compared with its width).
StalkCut cut_stalk(const Outline& outline);

struct PetioleGuess {
  int index = 0;            ///< of the margin point
  double confidence = 0.0;  ///< 0 to 1; below 0.5 the user should be told to pass --petiole
  std::string reason;       ///< "the deepest notch on the axis of symmetry", ...
};

/// Where the stalk of a blade is likeliest, from the shape of its margin alone (#M x 2): the axis of mirror
/// symmetry gives base and apex; a notch on it, or else the blunter, wider end, is the base. Deterministic,
/// invariant to rigid motion, scale and the start of the numbering.
PetioleGuess find_petiole(const Points2& margin);

/// Turns a mesh in file coordinates (#V x 3, Z up) into the leaf frame of leaf.hpp, filling positions,
/// petiole and placement. `metres_per_unit` scales it. The upper side is the one that the faces turn
/// counter-clockwise to.
void place_in_leaf_frame(Leaf& leaf, const Points3& file_positions, VertexId petiole, double metres_per_unit);

/// A leaf without a file, held by another place of its margin: the margin vertex nearest to `wanted` (x and y
/// in metres in the leaf frame that it has, its stalk at 0, 0) becomes the petiole and the leaf is put into
/// its frame anew; the stalk goes with it, the texture coordinates stay. Says so in its notes. Throws
/// Error{input} as place_in_leaf_frame does. O(#V), deterministic.
Leaf with_petiole(Leaf leaf, const Vec2& wanted);

}  // namespace wilt
