#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/geodesics/nearest_point.hpp"
#include "wilt/output/coordinates.hpp"
#include "wilt/output/vein_lines.hpp"
#include "wilt/output/veins_files.hpp"

namespace wilt {
namespace {

using Json = nlohmann::json;
using Rows = Eigen::MatrixXd;

constexpr double kOutside = 0.02;  // how far beside the blade a point is moved onto it, of the leaf's size
constexpr double kApart = 0.005;   // how far positions and uv of one point may be apart
constexpr double kOtherLength = 1e-6;  // relative, of two leaves

class Reader {
 public:
  Reader(std::string name, const Leaf& leaf, const Venation& found)
      : name_(std::move(name)), leaf_(leaf), lines_(vein_lines(leaf, found)), plane_(leaf.skin.uv.rows(), 3) {
    if (plane_.rows() > 0) plane_ << leaf.skin.uv, Eigen::VectorXd::Zero(plane_.rows());
  }

  std::vector<DrawnVein> read(const Json& document) const {
    if (!document.is_object() || !document.contains("veins") || !document["veins"].is_array())
      fail("there is no list \"veins\"; give a file as `wilt veins` writes it");
    if (document.contains("leaf")) check_leaf(document["leaf"]);
    std::vector<DrawnVein> veins;
    for (const Json& vein : document["veins"]) veins.push_back(read_vein(vein, veins.size()));
    return veins;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::input, fmt::format("'{}': {}", name_, message));
  }

 private:
  void check_leaf(const Json& written) const {
    const auto differ = [&](const char* key, double own) {
      if (!written.is_object() || !written.contains(key) || !written[key].is_number()) return;
      const double other = written[key].get<double>();
      if (std::abs(other - own) > kOtherLength * std::abs(own))
        fail(
            fmt::format("these are another leaf's veins: its {} is {}, this leaf's {}; give the LEAF, "
                        "--vertices and --seed that the file was made with",
                        key, other, own));
    };
    differ("vertices", leaf_.mesh.num_vertices());
    differ("faces", leaf_.mesh.num_faces());
    differ("length", leaf_length(leaf_));
  }

  DrawnVein read_vein(const Json& json, std::size_t index) const {
    const std::string place = fmt::format("veins[{}]", index);
    if (!json.is_object()) fail(place + " must be an object with \"order\" and \"positions\" or \"uv\"");
    static const std::vector<std::string> known{"order", "tip", "length", "positions", "uv", "pixel"};
    for (const auto& item : json.items()) {
      if (std::find(known.begin(), known.end(), item.key()) == known.end())
        fail(fmt::format("{}: unknown key \"{}\"{}; allowed are {}", place, item.key(),
                         did_you_mean(item.key(), known), fmt::join(known, ", ")));
    }
    if (!json.contains("order") || !json["order"].is_number_integer())
      fail(place + ": \"order\" must be 1 (primary) or 2 (secondary)");
    DrawnVein vein;
    vein.order = json["order"].get<int>();
    const std::optional<Rows> positions = rows(json, place, "positions", 3), uv = rows(json, place, "uv", 2),
                              pixel = rows(json, place, "pixel", 2);
    vein.found = pixel ? -1 : index_of(vein.order, positions, uv);
    if (vein.found < 0) vein.points = agreed_points(place, positions, uv, pixel);
    return vein;
  }

  std::optional<Rows> rows(const Json& json, const std::string& place, const char* key, int columns) const {
    if (!json.contains(key)) return std::nullopt;
    const auto wrong = [&] {
      fail(fmt::format("{}: \"{}\" must be a list of points of {} numbers", place, key, columns));
    };
    const Json& list = json[key];
    if (!list.is_array() || list.empty()) wrong();
    Rows values(static_cast<Eigen::Index>(list.size()), columns);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].is_array() || list[i].size() != static_cast<std::size_t>(columns)) wrong();
      for (int c = 0; c < columns; ++c) {
        const Json& value = list[i][static_cast<std::size_t>(c)];
        if (!value.is_number()) wrong();
        values(static_cast<Eigen::Index>(i), c) = value.get<double>();
      }
    }
    return values;
  }

  // The vein found that was written as this one; -1: none, it was edited.
  int index_of(int order, const std::optional<Rows>& positions, const std::optional<Rows>& uv) const {
    if (!positions && !uv) return -1;
    const auto same = [](const std::optional<Rows>& given, const auto& own) {
      return !given || (given->rows() == own.rows() && *given == own);
    };
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].order == order && same(uv, lines_[i].uv) &&
          same(positions, file_points(leaf_.placement, lines_[i].positions)))
        return static_cast<int>(i);
    }
    return -1;
  }

  // The same places, however many ways they are given in.
  std::vector<SurfacePoint> agreed_points(const std::string& place, const std::optional<Rows>& positions,
                                          const std::optional<Rows>& uv,
                                          const std::optional<Rows>& pixel) const {
    std::vector<std::vector<SurfacePoint>> ways;
    if (positions) ways.push_back(in_space(place, *positions));
    if (uv) ways.push_back(in_plane(place, "uv", *uv));
    if (pixel) ways.push_back(in_plane(place, "pixel", uv_of_pixels(place, *pixel)));
    if (ways.empty()) fail(place + " has neither \"positions\" nor \"uv\" nor \"pixel\"");
    for (std::size_t k = 1; k < ways.size(); ++k) {
      bool agree = ways[k].size() == ways[0].size();
      for (std::size_t i = 0; agree && i < ways[0].size(); ++i)
        agree = (at(ways[k][i]) - at(ways[0][i])).norm() <= kApart * leaf_length(leaf_);
      if (!agree)
        fail(place +
             ": \"positions\", \"uv\" and \"pixel\" are not the same places; keep only what you edited");
    }
    return ways[0];
  }

  std::vector<SurfacePoint> in_space(const std::string& place, const Rows& positions) const {
    return nearest(place, "positions", leaf_.mesh.face_matrix(), leaf_.positions,
                   leaf_points(leaf_.placement, positions), leaf_length(leaf_));
  }

  std::vector<SurfacePoint> in_plane(const std::string& place, const char* key, const Rows& uv) const {
    if (plane_.rows() == 0)
      fail(fmt::format("{}: \"{}\" needs texture coordinates, which this leaf has not; give \"positions\"",
                       place, key));
    Points3 points(uv.rows(), 3);
    points << uv, Eigen::VectorXd::Zero(uv.rows());
    const double extent = (plane_.colwise().maxCoeff() - plane_.colwise().minCoeff()).maxCoeff();
    return nearest(place, key, leaf_.skin.faces, plane_, points, extent);
  }

  Rows uv_of_pixels(const std::string& place, const Rows& pixels) const {
    if (!leaf_.photo) fail(place + ": \"pixel\" needs a photo; give \"positions\" or \"uv\"");
    const PhotoArea& area = leaf_.photo->area;
    return (pixels.rowwise() - area.origin.transpose()).array().rowwise() / area.size.transpose().array();
  }

  std::vector<SurfacePoint> nearest(const std::string& place, const char* key, const Faces& faces,
                                    const Points3& corners, const Points3& points, double extent) const {
    std::vector<SurfacePoint> found;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const NearestPoint near = nearest_point(faces, corners, points.row(i).transpose());
      if (!(near.distance <= kOutside * extent))
        fail(
            fmt::format("{}.{}[{}] lies {:.1f} % of the leaf's size beside the blade; at most {:.0f} % are "
                        "allowed",
                        place, key, i, 100.0 * near.distance / extent, 100.0 * kOutside));
      found.push_back(near.point);
    }
    return found;
  }

  Vec3 at(const SurfacePoint& point) const { return position(leaf_.mesh, leaf_.positions, point); }

  std::string name_;
  const Leaf& leaf_;
  std::vector<RestVein> lines_;
  Points3 plane_;  // texture coordinates, z = 0
};

}  // namespace

std::vector<DrawnVein> parse_veins_json(const std::string& text, const std::string& name, const Leaf& leaf,
                                        const Venation& found) {
  const Reader reader(name, leaf, found);
  const Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded())
    reader.fail("it is not JSON; give a file as `wilt veins -o veins.json` writes it");
  return reader.read(document);
}

}  // namespace wilt
