#include "wilt/output/glb_extras.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "wilt/core/version.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/vein_lines.hpp"

namespace wilt {
namespace {

using Json = nlohmann::ordered_json;

// Nine decimals: a nanometre.
Json rounded(const Points3& points) {
  Json rows = Json::array();
  for (int i = 0; i < points.rows(); ++i) {
    Json row = Json::array();
    for (int c = 0; c < 3; ++c) row.push_back(std::round(points(i, c) * 1e9) / 1e9);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json veins_json(const Clip& clip) {
  Json veins = Json::array();
  if (clip.venation == nullptr) return veins;
  const std::vector<RestVein> lines = vein_lines(clip.leaf, *clip.venation);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<SurfacePoint>& path = clip.venation->veins[i].path.points;
    std::vector<int> faces;
    Points3 barycentric(static_cast<int>(path.size()), 3);
    for (const SurfacePoint& point : path) {
      barycentric.row(static_cast<int>(faces.size())) = point.barycentric;
      faces.push_back(point.face);
    }
    veins.push_back({{"order", lines[i].order},
                     {"positions", rounded(file_points(clip.leaf.placement, lines[i].positions))},
                     {"faces", faces},
                     {"barycentric", rounded(barycentric)}});
  }
  return veins;
}

}  // namespace

std::string glb_extras(const Clip& clip, const FrameChoice& choice) {
  Json frames = Json::array();
  Json dryness = Json::array();
  for (const int k : choice.kept) {
    const Frame& frame = clip.frames[static_cast<std::size_t>(k)];
    frames.push_back(frame.iteration);
    dryness.push_back(frame.dryness.size() > 0 ? std::round(frame.dryness.mean() * 1e6) / 1e6 : 0.0);
  }
  const Leaf& leaf = clip.leaf;
  Json extras = {{"version", version()},
                 {"config", Json::parse(clip.config)},
                 {"leaf", {{"name", leaf.name}, {"species", leaf.species}, {"seed", leaf.seed}}},
                 {"units", unit_name(leaf.placement)},
                 {"metres_per_unit", metres_per_unit(leaf.placement)},
                 {"up", "Y"},
                 {"frames", frames},
                 {"dryness", dryness},
                 {"veins", veins_json(clip)}};
  if (choice.kept.size() > 1 && choice.kept.size() < clip.frames.size())
    extras["left_out"] = {{"of", clip.frames.size()}, {"rms", choice.rms}, {"largest", choice.largest}};
  return extras.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace wilt
