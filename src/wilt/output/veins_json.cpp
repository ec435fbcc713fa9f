#include <nlohmann/json.hpp>

#include "wilt/mesh/geometry.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/vein_lines.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

template <class Row>
Json numbers(const Row& values) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) list.push_back(values(i));
  return list;
}

template <class Rows>
Json rows(const Rows& values) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) list.push_back(numbers(values.row(i)));
  return list;
}

// "vertex", "position", "uv" and, in a photo, "pixel".
Json vertex_json(const Leaf& leaf, VertexId vertex) {
  const Vec2 uv = vertex_uv(leaf, vertex);
  const Points3 position = file_points(leaf.placement, leaf.positions.row(vertex));
  Json json = {{"vertex", int(vertex)}, {"position", numbers(position)}, {"uv", numbers(uv)}};
  if (leaf.photo) {
    const PhotoArea& area = leaf.photo->area;
    json["pixel"] = numbers((area.origin + uv.cwiseProduct(area.size)).eval());
  }
  return json;
}

Json leaf_json(const Leaf& leaf) {
  int boundary_vertices = 0;
  for (const auto& loop : leaf.mesh.boundary_loops()) boundary_vertices += static_cast<int>(loop.size());
  return {{"vertices", leaf.mesh.num_vertices()},
          {"faces", leaf.mesh.num_faces()},
          {"length", leaf_length(leaf)},
          {"boundary_vertices", boundary_vertices}};
}

}  // namespace

std::string veins_json(const Leaf& leaf, const Venation& venation) {
  Json tips = Json::array();
  for (const Tip& tip : venation.tips) {
    Json json = vertex_json(leaf, tip.vertex);
    json["s"] = tip.s;
    json["d"] = tip.d;
    json["prominence"] = tip.prominence;
    tips.push_back(std::move(json));
  }
  Json veins = Json::array();
  const std::vector<RestVein> lines = vein_lines(leaf, venation);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Json json = {{"order", lines[i].order}};
    if (lines[i].tip >= 0) json["tip"] = lines[i].tip;
    json["length"] = venation.veins[i].path.length;
    json["positions"] = rows(file_points(leaf.placement, lines[i].positions));
    json["uv"] = rows(lines[i].uv);
    veins.push_back(std::move(json));
  }
  const Json document = {{"leaf", leaf_json(leaf)},
                         {"petiole", vertex_json(leaf, leaf.petiole)},
                         {"margin", {{"s", numbers(venation.margin.s)}, {"d", numbers(venation.margin.d)}}},
                         {"tips", std::move(tips)},
                         {"veins", std::move(veins)}};
  return document.dump() + "\n";
}

}  // namespace wilt
