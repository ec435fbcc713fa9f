// Which of a drawing's shapes is the leaf. Inside the import room only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wilt/import/svg_shapes.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

struct ChosenLeaf {
  Outline outline;                 ///< in the drawing's units, y down
  std::optional<Vec2> stalk_foot;  ///< where a stalk that only nearly touches the blade points at it
  std::vector<std::string> notes;
};

/// The `nth` largest leaf-like shape. Left out are backgrounds (a rectangle around all else), shadows (grey,
/// blurred or faint, under or beside a coloured shape that is much the same), repeated fills of one outline,
/// details inside a leaf, and stalks; a stalk that overlaps the leaf is joined to it.
/// Throws Error{input} when there are fewer.
ChosenLeaf choose_leaf(const svg::Drawing& drawing, int nth);

}  // namespace wilt::detail
