#include "wilt/output/moving.hpp"

#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/tube.hpp"

namespace wilt {
Moving moving_blade(const GlbScene& scene) {
  const Leaf& leaf = scene.leaf;
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
  moving.colour_count = static_cast<int>(scene.colours.size());
  const Eigen::VectorXd& water = scene.frames.back().water_fraction;
  if (water.size() > 0) {
    moving.water.resize(size);
    for (int s = 0; s < size; ++s) moving.water[s] = water[leaf.skin.vertex[static_cast<std::size_t>(s)]];
  }
  moving.shape = [&scene, &leaf, spread](int k) {
    const Points3& positions = scene.frames[static_cast<std::size_t>(k)].positions;
    const Points3 normals = vertex_normals(leaf.mesh, positions);
    return Shape{spread(file_points(leaf.placement, positions)),
                 spread(file_normals(leaf.placement, normals))};
  };
  moving.colours = [&scene, spread](int k) -> Points3 {
    return spread(scene.colours[static_cast<std::size_t>(k)].cwiseMax(0.0).cwiseMin(1.0));
  };
  return moving;
}

Moving moving_stalk(const GlbScene& scene, int sides) {
  const Leaf& leaf = scene.leaf;
  const Vec3 reference = tube_reference(scene.frames.front().stalk);
  const auto at = [&scene, &leaf, sides, reference](int k) {
    return tube(scene.frames[static_cast<std::size_t>(k)].stalk, leaf.stalk.radii, sides, reference);
  };
  Moving moving;
  moving.name = "stalk";
  const Tube rest = at(0);
  const int size = static_cast<int>(rest.positions.rows());
  moving.faces = rest.faces;
  moving.colour_count = static_cast<int>(scene.stalk_colours.size());
  moving.shape = [&leaf, at](int k) {
    const Tube shape = at(k);
    return Shape{file_points(leaf.placement, shape.positions), file_normals(leaf.placement, shape.normals)};
  };
  moving.colours = [&scene, size](int k) -> Points3 {
    const Vec3 colour = scene.stalk_colours[static_cast<std::size_t>(k)].cwiseMax(0.0).cwiseMin(1.0);
    return colour.transpose().replicate(size, 1);
  };
  return moving;
}

}  // namespace wilt
