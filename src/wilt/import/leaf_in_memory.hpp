// A leaf from what a program holds in memory: triangles, an outline, a leaf cut out of a photo.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/import/read_leaf.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt {

/// Triangles in memory.
struct MeshArrays {
  Points3 positions;           ///< #S x 3, metres, Z up; a file's (X, Y, Z), Y up, is (X, -Z, Y) here
  Faces faces;                 ///< #F x 3, rows of `positions`, counted from 0
  Points2 uv{};                ///< #S x 2, glTF convention (origin top left); or none
  std::optional<int> petiole;  ///< the row of `positions` nearest to which the stalk meets the blade's margin
};

/// The leaf `name`, with the checks and repairs of a mesh file. Of the options, those of a mesh count. Throws
/// Error{input}.
Leaf leaf_from_arrays(const MeshArrays& mesh, const std::string& name, const ReadOptions& options = {},
                      const Monitor& monitor = {});

/// An outline before it is a leaf.
struct DrawnLeaf {
  Outline outline;              ///< in the file's units, y up
  std::optional<Vec2> petiole;  ///< as the file or the user gave it, or as it was found, y up
  std::string petiole_reason;   ///< how it was found; empty: given
  double mm_per_unit = 1.0;
  bool y_down = false;  ///< whether the file's y runs down: for messages
  std::shared_ptr<const LeafPhoto>
      photo;  ///< whose pixels are the outline's units; mm_per_unit is then the options'
  std::vector<std::string> notes;
};

/// {"outline": [[x, y], ...], "holes": [[[x, y], ...], ...], "petiole": [x, y], "mm_per_unit": 1}, y up;
/// only "outline" must be there. Throws Error{input}, naming the place, for anything else.
DrawnLeaf parse_json_outline(std::string_view text);

/// The `nth` largest leaf of a drawing (SVG) that somebody else parsed: its elements as JSON, [[depth, name,
/// {attribute: value, ...}, text of a style sheet], ...] in the order of the document, the root at depth 0.
/// Throws Error{input}.
DrawnLeaf drawn_from_elements(std::string_view json, int nth);

/// The leaf `name` of an outline: its stalk is cut off, its petiole found, the blade meshed. Of the options,
/// those of an outline count, and of a photo's, mm_per_pixel. Throws Error{input}. Deterministic.
Leaf leaf_from_drawing(DrawnLeaf drawn, const std::string& name, const ReadOptions& options = {},
                       const Monitor& monitor = {});

}  // namespace wilt
