#include "wilt/output/vein_lines.hpp"

#include <algorithm>

#include "wilt/core/check.hpp"

namespace wilt {
namespace {

// The value at a point of a face whose corners have the rows faces(face, .) of `values`.
template <class Values>
auto interpolate(const Faces& faces, const Values& values, const SurfacePoint& point) {
  const auto corners = faces.row(int(point.face));
  return (point.barycentric[0] * values.row(corners[0]) + point.barycentric[1] * values.row(corners[1]) +
          point.barycentric[2] * values.row(corners[2]))
      .eval();
}

}  // namespace

std::vector<RestVein> vein_lines(const Leaf& leaf, const Venation& venation) {
  std::vector<RestVein> lines;
  lines.reserve(venation.veins.size());
  for (const Vein& vein : venation.veins) {
    const int count = static_cast<int>(vein.path.points.size());
    RestVein line{vein.order, vein.tip, Points3(count, 3), Points2(count, 2)};
    for (int i = 0; i < count; ++i) {
      const SurfacePoint& point = vein.path.points[static_cast<std::size_t>(i)];
      line.positions.row(i) = interpolate(leaf.mesh.face_matrix(), leaf.positions, point);
      line.uv.row(i) = interpolate(leaf.skin.faces, leaf.skin.uv, point);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

Vec2 vertex_uv(const Leaf& leaf, VertexId vertex) {
  const auto found = std::find(leaf.skin.vertex.begin(), leaf.skin.vertex.end(), vertex);
  WILT_CHECK(found != leaf.skin.vertex.end(), vertex);
  return leaf.skin.uv.row(static_cast<int>(found - leaf.skin.vertex.begin()));
}

}  // namespace wilt
