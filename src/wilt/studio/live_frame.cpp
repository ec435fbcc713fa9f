#include "wilt/studio/live_frame.hpp"

#include <algorithm>

#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/tube.hpp"

namespace wilt {
namespace {

constexpr int kStalkSides = 10;

std::vector<float> packed(const Points3& points) {
  return {points.data(), points.data() + points.size()};
}

std::vector<float> y_up(const Points3& points) {
  return packed(file_points(Placement{}, points));
}

// Values of mesh vertices at the points of the skin.
Points3 at_points(const Skin& skin, const Points3& of_vertices) {
  Points3 of_points(static_cast<Eigen::Index>(skin.vertex.size()), 3);
  for (std::size_t p = 0; p < skin.vertex.size(); ++p)
    of_points.row(static_cast<Eigen::Index>(p)) = of_vertices.row(skin.vertex[p]);
  return of_points;
}

std::vector<float> at_points(const Skin& skin, const Eigen::VectorXd& of_vertices) {
  std::vector<float> of_points;
  of_points.reserve(skin.vertex.size());
  for (const VertexId v : skin.vertex) of_points.push_back(static_cast<float>(of_vertices[v]));
  return of_points;
}

// The first point of the skin at each vertex of the mesh.
std::vector<std::uint32_t> first_points(const Leaf& leaf) {
  std::vector<std::uint32_t> first(static_cast<std::size_t>(leaf.mesh.num_vertices()));
  for (std::size_t p = leaf.skin.vertex.size(); p-- > 0;)
    first[static_cast<std::size_t>(int(leaf.skin.vertex[p]))] = static_cast<std::uint32_t>(p);
  return first;
}

std::vector<std::uint32_t> indices(const Faces& faces) {
  return {faces.data(), faces.data() + faces.size()};
}

Tube stalk_tube(const Leaf& leaf, const Points3& centreline) {
  return tube(centreline, leaf.stalk.radii, kStalkSides, tube_reference(leaf.stalk.centreline));
}

bool has_stalk(const Leaf& leaf) {
  return leaf.stalk.centreline.rows() >= 2;
}

Points3 vein_points(const Leaf& leaf, const Venation& venation, const Points3& positions) {
  std::size_t count = 0;
  for (const Vein& vein : venation.veins) count += vein.path.points.size();
  Points3 points(static_cast<Eigen::Index>(count), 3);
  Eigen::Index row = 0;
  for (const Vein& vein : venation.veins)
    for (const SurfacePoint& point : vein.path.points)
      points.row(row++) = position(leaf.mesh, positions, point).transpose();
  return points;
}

}  // namespace

LiveLeaf live_leaf(const StudioSession& session) {
  const Leaf& leaf = session.leaf();
  const Venation& venation = session.venation();
  const std::vector<std::uint32_t> first = first_points(leaf);
  const auto point = [&first](VertexId v) { return first[static_cast<std::size_t>(int(v))]; };
  LiveLeaf live;
  for (const VertexId v : leaf.skin.vertex) live.vertex.push_back(static_cast<std::uint32_t>(int(v)));
  live.faces = indices(leaf.skin.faces);
  live.uv.assign(leaf.skin.uv.data(), leaf.skin.uv.data() + leaf.skin.uv.size());
  if (has_stalk(leaf)) {
    const Tube stalk = stalk_tube(leaf, leaf.stalk.centreline);
    live.stalk_points = static_cast<std::uint32_t>(stalk.positions.rows());
    live.stalk_faces = indices(stalk.faces);
  }
  for (const Tip& tip : venation.tips) live.tip_points.push_back(point(tip.vertex));
  for (const VertexId v : venation.margin.vertices) live.margin_points.push_back(point(v));
  std::uint32_t start = 0;
  for (const Vein& vein : venation.veins) {
    live.vein_start.push_back(start);
    live.vein_order.push_back(static_cast<std::uint8_t>(vein.order));
    start += static_cast<std::uint32_t>(vein.path.points.size());
  }
  live.vein_start.push_back(start);
  live.petiole_point = point(leaf.petiole);
  return live;
}

LiveFrame live_frame(const StudioSession& session) {
  const Leaf& leaf = session.leaf();
  const Simulation& simulation = session.simulation();
  const DeformationModel& model = simulation.model();
  const Frame frame = simulation.frame();
  LiveFrame live;
  live.positions = y_up(at_points(leaf.skin, frame.positions));
  live.normals = y_up(at_points(leaf.skin, vertex_normals(leaf.mesh, frame.positions)));
  live.colours = packed(at_points(leaf.skin, session.paint().blade(frame.dryness)));
  if (has_stalk(leaf)) {
    const Tube stalk = stalk_tube(leaf, frame.stalk);
    live.stalk_positions = y_up(stalk.positions);
    live.stalk_normals = y_up(stalk.normals);
  }
  const Vec3 stalk = session.paint().stalk(frame.dryness);
  for (int c = 0; c < 3; ++c) live.stalk_colour[static_cast<std::size_t>(c)] = static_cast<float>(stalk[c]);
  live.veins = y_up(vein_points(leaf, session.venation(), frame.positions));
  const ForceBreakdown forces = model.forces(simulation.motion().positions, simulation.motion().velocities);
  const std::array<Eigen::VectorXd, LiveFrame::kFields.size()> fields = {model.water() + model.dry_mass(),
                                                                         model.water(),
                                                                         frame.water_fraction,
                                                                         frame.dryness,
                                                                         -model.pressure_drop(),
                                                                         forces.elastic.rowwise().norm(),
                                                                         forces.damping.rowwise().norm(),
                                                                         forces.swelling.rowwise().norm(),
                                                                         forces.external.rowwise().norm()};
  for (std::size_t k = 0; k < fields.size(); ++k) live.fields[k] = at_points(leaf.skin, fields[k]);
  live.tip_forces = y_up(model.tip_forces());
  live.water_left = model.water().sum() / session.first_water();
  return live;
}

}  // namespace wilt
