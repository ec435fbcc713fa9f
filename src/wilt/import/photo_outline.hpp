// From covered pixels to an outline. Inside the import room only.
#pragma once

#include "wilt/import/photo_objects.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

/// The outline of an object to a fraction of a pixel, x to the right and y up from the photo's top left
/// corner (so y is negative), in units of `scale`: the line where half a pixel is covered, by marching
/// squares (Lorensen and Cline 1987, in the plane), which never crosses itself. Holes of at least 16 pixels
/// are kept. Throws Error{input} when nothing is left that has an area.
Outline trace_outline(const PhotoObject& object, double scale);

}  // namespace wilt::detail
