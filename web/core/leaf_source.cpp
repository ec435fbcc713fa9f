#include "leaf_source.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "wilt/core/error.hpp"
#include "wilt/import/leaf_in_memory.hpp"
#include "wilt/import/reading.hpp"
#include "wilt/leaf/petiole.hpp"
#include "wilt/leaf/species.hpp"

namespace wilt::web {
namespace {

constexpr int kUsualVertices = 2000;  // of a species
constexpr double kMetres = 0.001;     // a species' petiole is given in millimetres

int whole(const val& object, const char* key) {
  return static_cast<int>(object[key].as<double>());
}

std::string text(const val& object, const char* key) {
  return object[key].as<std::string>();
}

Vec2 point(const val& pair) {
  return {pair[0].as<double>(), pair[1].as<double>()};
}

std::optional<Vec2> optional_point(const val& object, const char* key) {
  const val pair = object[key];
  if (pair.isUndefined()) return std::nullopt;
  return point(pair);
}

ReadOptions options_of(const val& source) {
  ReadOptions options;
  if (const int vertices = whole(source, "vertices"); vertices != 0) options.vertices = vertices;
  options.seed = static_cast<std::uint64_t>(source["seed"].as<double>());
  options.petiole = optional_point(source, "petiole");
  return options;
}

template <class Matrix>
Matrix rows_of(const std::vector<double>& values) {
  constexpr Eigen::Index columns = Matrix::ColsAtCompileTime;
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, columns, Eigen::RowMajor>>(
             values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns)
      .template cast<typename Matrix::Scalar>();
}

// (X, Y, Z) of a file, Y up, is (X, -Z, Y) here.
Leaf mesh_leaf(const val& source) {
  MeshArrays mesh;
  const Points3 file = rows_of<Points3>(doubles(source["positions"]));
  mesh.positions.resize(file.rows(), 3);
  mesh.positions << file.col(0), -file.col(2), file.col(1);
  mesh.faces = rows_of<Faces>(doubles(source["faces"]));
  if (const val uv = source["uv"]; !uv.isUndefined()) mesh.uv = rows_of<Points2>(doubles(uv));
  return leaf_from_arrays(mesh, text(source, "name"), options_of(source));
}

std::vector<std::uint8_t> octets(const val& array) {
  return emscripten::convertJSArrayToNumberVector<std::uint8_t>(array);
}

Points2 y_up(Points2 pixels) {
  pixels.col(1) *= -1.0;
  return pixels;
}

std::shared_ptr<const LeafPhoto> photo_of(const val& cut_out) {
  auto photo = std::make_shared<LeafPhoto>();
  const int size = whole(cut_out, "size");
  photo->image = {size, size, octets(cut_out["rgb"])};
  const val area = cut_out["area"];
  photo->area.origin = {area["x"].as<double>(), area["y"].as<double>()};
  photo->area.size = {area["width"].as<double>(), area["height"].as<double>()};
  photo->ridges = {whole(cut_out, "ridgeSize"),
                   emscripten::convertJSArrayToNumberVector<float>(cut_out["ridges"])};
  return photo;
}

DrawnLeaf drawn_of(const val& cut_out) {
  DrawnLeaf drawn;
  drawn.outline.margin = y_up(points2(cut_out["margin"]));
  for (const val& hole : emscripten::vecFromJSArray<val>(cut_out["holes"]))
    drawn.outline.holes.push_back(y_up(points2(hole)));
  drawn.y_down = true;
  drawn.notes = emscripten::vecFromJSArray<std::string>(cut_out["notes"]);
  drawn.photo = photo_of(cut_out);
  if (const auto fork = optional_point(cut_out, "fork")) {
    drawn.petiole = Vec2(fork->x(), -fork->y());
    drawn.petiole_reason = fmt::format("where {} main veins meet", whole(cut_out, "forkVeins"));
  }
  return drawn;
}

}  // namespace

Points2 points2(const val& array) {
  const std::vector<double> values = doubles(array);
  if (values.size() % 2 != 0) throw Error(ErrorCode::input, "a ring of points ends with half a point");
  return rows_of<Points2>(values);
}

Leaf species_leaf(const val& source) {
  const int asked = whole(source, "vertices");
  return make_leaf(text(source, "name"), asked == 0 ? kUsualVertices : asked,
                   static_cast<std::uint64_t>(source["seed"].as<double>()));
}

Leaf leaf_of(const val& source) {
  const std::string kind = text(source, "kind");
  if (kind == "species") {
    const std::optional<Vec2> petiole = optional_point(source, "petiole");
    return petiole ? with_petiole(species_leaf(source), kMetres * *petiole) : species_leaf(source);
  }
  if (kind == "mesh") return mesh_leaf(source);
  const std::string name = text(source, "name");
  const auto drawn = [&] {  // what is refused is called by its name
    return detail::naming(name, [&] {
      if (kind == "outline") return parse_json_outline(text(source, "outline"));
      if (kind == "drawing") return drawn_from_elements(text(source, "elements"), whole(source, "nth"));
      return drawn_of(source["photo"]);
    });
  };
  if (kind == "outline" || kind == "drawing" || kind == "photo")
    return leaf_from_drawing(drawn(), name, options_of(source));
  throw Error(ErrorCode::input, fmt::format("'{}' is no kind of leaf", kind));
}

std::string preset_of(const val& source) {
  return text(source, "kind") == "species" ? text(source, "name") : "generic";
}

std::vector<Assignment> given_with(const val& source) {
  return {{"vertices", fmt::format("{}", whole(source, "vertices"))},
          {"seed", fmt::format("{:.0f}", source["seed"].as<double>())}};
}

}  // namespace wilt::web
