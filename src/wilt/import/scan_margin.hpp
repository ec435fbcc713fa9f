// The outline of points in the plane. Inside the import room only.
#pragma once

#include "wilt/core/types.hpp"
#include "wilt/leaf/outline.hpp"

namespace wilt::detail {

struct ScanMarginOptions {
  double spacing = 1.0;         ///< of the points, where they are as usual
  double coarse_spacing = 1.0;  ///< where they are sparse
  double noise = 0.0;           ///< of the points, the same in all directions
};

struct ScanMargin {
  Outline outline;
  std::vector<char> inside;  ///< whether a point has a triangle in the shape
};

/// The alpha shape (Edelsbrunner, Kirkpatrick, Seidel 1983): Delaunay triangles with a circumradius up
/// to 1.6 coarse spacings, their largest piece, without places where it hangs together by a single point.
/// Holes up to some coarse spacings across are closed. The rings are smoothed at the scale of spacing and
/// noise, and moved outwards by what lies between the outermost points and the margin, less what the noise
/// carried them out. Throws Error{input} when no simple ring comes out. O(#P log #P).
ScanMargin find_scan_margin(const Points2& points, const ScanMarginOptions& options);

}  // namespace wilt::detail
