// The small languages inside SVG attributes: path data, transforms, paints, lengths.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"

namespace wilt::svg {

/// One closed ring of a path, flattened; the last point is not the first.
using Ring = std::vector<Vec2>;

/// Maps a shape's own coordinates to the drawing's.
using Transform = Eigen::Affine2d;

/// Path data ("M 0,0 C ...") as rings, mapped by `transform`, curves flattened to within `tolerance` (in the
/// drawing's units). Open subpaths are closed, as filling does. Throws Error{input} on data that is no path.
std::vector<Ring> flatten_path(const std::string& data, const Transform& transform, double tolerance);

/// A transform list ("translate(1,2) rotate(30)"). Throws Error{input} when it cannot be read.
Transform parse_transform(const std::string& text);

struct Paint {
  enum class Kind { none, colour, server, inherit };  ///< server: a gradient or a pattern
  Kind kind = Kind::colour;
  double red = 0.0, green = 0.0, blue = 0.0;  ///< 0 to 1
};

/// A fill ("#f80", "none", "url(#gradient)"); nothing when it cannot be read, which SVG ignores.
std::optional<Paint> parse_paint(const std::string& text);

struct Length {
  double value = 0.0;
  std::string unit;  ///< "", "px", "mm", "%", ...
};

/// A number with a unit; nothing when it cannot be read.
std::optional<Length> parse_length(const std::string& text);

/// Millimetres in one unit of a physical length (mm, cm, in, pt, pc, Q); nothing for px, em, % and none.
std::optional<double> millimetres(const std::string& unit);

}  // namespace wilt::svg
