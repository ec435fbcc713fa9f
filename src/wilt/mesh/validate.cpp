#include "wilt/mesh/validate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wilt/core/check.hpp"
#include "wilt/core/error.hpp"
#include "wilt/mesh/geometry.hpp"

namespace wilt {

void validate_blade(const SurfaceMesh& mesh, const Points3& positions) {
  WILT_CHECK(positions.rows() == mesh.num_vertices(), positions.rows(), mesh.num_vertices());
  for (const VertexId v : mesh.vertices()) {
    if (!positions.row(v).allFinite())
      throw Error(ErrorCode::input,
                  fmt::format("vertex {} lies at ({}, {}, {}); positions must be finite numbers", int(v),
                              positions(int(v), 0), positions(int(v), 1), positions(int(v), 2)));
  }
  int count = 0;
  mesh.components(&count);
  if (count > 1)
    throw Error(ErrorCode::input,
                fmt::format("the surface falls into {} separate parts; a leaf blade is one piece", count));
  margin_loop(mesh, positions);
  const double mean_area = surface_area(mesh, positions) / mesh.num_faces();
  const FaceData<double> areas = face_areas(mesh, positions);
  for (const FaceId f : mesh.faces()) {
    if (!(areas[f] > 1e-12 * mean_area)) {
      const auto [a, b, c] = mesh.face_vertices(f);
      throw Error(ErrorCode::input,
                  fmt::format("face {} (vertices {}, {}, {}) has no area; remove it or move a vertex", int(f),
                              int(a), int(b), int(c)));
    }
  }
}

}  // namespace wilt
