#include "wilt/output/moving.hpp"

#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/tube.hpp"

namespace wilt {

Shape blade_shape(const Clip& clip, int frame) {
  const Leaf& leaf = clip.leaf;
  const Points3& positions = clip.frames[static_cast<std::size_t>(frame)].positions;
  return {file_points(leaf.placement, positions),
          file_normals(leaf.placement, vertex_normals(leaf.mesh, positions))};
}

Moving moving_blade(const Clip& clip) {
  const Leaf& leaf = clip.leaf;
  const int size = static_cast<int>(leaf.skin.vertex.size());
  const auto spread = [&leaf, size](const Points3& of_vertices) {
    Points3 of_skin(size, 3);
    for (int s = 0; s < size; ++s)
      of_skin.row(s) = of_vertices.row(leaf.skin.vertex[static_cast<std::size_t>(s)]);
    return of_skin;
  };
  Moving moving;
  moving.name = "blade";
  moving.faces = leaf.skin.faces;
  moving.uv = leaf.skin.uv;
  moving.colour_count = static_cast<int>(clip.colours.size());
  const Eigen::VectorXd& water = clip.frames.back().water_fraction;
  if (water.size() > 0) {
    moving.water.resize(size);
    for (int s = 0; s < size; ++s) moving.water[s] = water[leaf.skin.vertex[static_cast<std::size_t>(s)]];
  }
  moving.shape = [&clip, spread](int k) {
    const Shape shape = blade_shape(clip, k);
    return Shape{spread(shape.positions), spread(shape.normals)};
  };
  moving.colours = [&clip, spread](int k) -> Points3 {
    return spread(clip.colours[static_cast<std::size_t>(k)].cwiseMax(0.0).cwiseMin(1.0));
  };
  return moving;
}

Moving moving_stalk(const Clip& clip, int sides) {
  const Leaf& leaf = clip.leaf;
  const Vec3 reference = tube_reference(clip.frames.front().stalk);
  const auto at = [&clip, &leaf, sides, reference](int k) {
    return tube(clip.frames[static_cast<std::size_t>(k)].stalk, leaf.stalk.radii, sides, reference);
  };
  Moving moving;
  moving.name = "stalk";
  const Tube rest = at(0);
  const int size = static_cast<int>(rest.positions.rows());
  moving.faces = rest.faces;
  moving.colour_count = static_cast<int>(clip.stalk_colours.size());
  moving.shape = [&leaf, at](int k) {
    const Tube shape = at(k);
    return Shape{file_points(leaf.placement, shape.positions), file_normals(leaf.placement, shape.normals)};
  };
  moving.colours = [&clip, size](int k) -> Points3 {
    const Vec3 colour = clip.stalk_colours[static_cast<std::size_t>(k)].cwiseMax(0.0).cwiseMin(1.0);
    return colour.transpose().replicate(size, 1);
  };
  return moving;
}

}  // namespace wilt
