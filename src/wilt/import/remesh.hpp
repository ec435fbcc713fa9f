// A sheet with another number of vertices. Inside the import room only.
#pragma once

#include "wilt/core/monitor.hpp"
#include "wilt/import/surface_repair.hpp"

namespace wilt::detail {

struct Remeshed {
  Sheet sheet;
  VertexId petiole;
};

/// Lays the sheet out in the plane, meshes its outline anew and maps back by barycentric interpolation.
/// Texture coordinates are interpolated within their chart: a new face takes the chart that its centroid
/// lies in, and its vertices are split where charts meet. `vertices` 200 to 1,000,000. Deterministic.
Remeshed remesh(const Sheet& sheet, VertexId petiole, int vertices, const Monitor& monitor);

}  // namespace wilt::detail
