// wilt.Leaf: a leaf at rest, and the ways to come by one.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>

#include "arrays.hpp"
#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "objects.hpp"
#include "wilt/core/error.hpp"
#include "wilt/import/leaf_in_memory.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/run/leaf_request.hpp"

namespace wilt::python {
namespace {

using Shared = std::shared_ptr<LeafObject>;
using Point = std::optional<std::array<double, 2>>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Whole = py::array_t<std::int64_t, py::array::c_style>;

Shared made(std::optional<int> vertices, const std::function<Leaf(const Monitor&)>& make) {
  auto object = std::make_shared<LeafObject>();
  object->vertices = vertices;
  computing([&](const Monitor& monitor) {
    const auto start = std::chrono::steady_clock::now();
    object->leaf = make(monitor);
    object->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
  return object;
}

Shared from_species(const std::string& name, std::optional<int> vertices, std::uint64_t seed) {
  return made(vertices, [&](const Monitor& monitor) {
    return make_leaf(name, vertices.value_or(kDefaultVertices), seed, monitor);
  });
}

Shared read(const std::filesystem::path& file, const ReadOptions& options) {
  LeafRequest request;
  request.leaf = is_species(file.string()) ? "./" + file.string() : file.string();
  request.read = options;
  Shared leaf;
  reading(file, [&] {
    leaf = made(options.vertices, [&](const Monitor& monitor) { return load_leaf(request, monitor); });
  });
  return leaf;
}

std::optional<Vec2> pair_of(const Point& point) {
  if (!point) return std::nullopt;
  return Vec2((*point)[0], (*point)[1]);
}

// What every kind of file takes.
ReadOptions read_options(std::optional<int> vertices, const Point& petiole, int nth, std::uint64_t seed) {
  ReadOptions options;
  options.vertices = vertices;
  options.petiole = pair_of(petiole);
  options.nth = nth;
  options.seed = seed;
  return options;
}

Shared from_file(const std::filesystem::path& path, std::optional<int> vertices, const Point& petiole,
                 int nth, std::uint64_t seed, bool scan, std::optional<double> mm_per_unit) {
  ReadOptions options = read_options(vertices, petiole, nth, seed);
  options.scan = scan;
  options.mm_per_unit = mm_per_unit;
  return read(path, options);
}

Shared from_photo(const std::filesystem::path& path, std::optional<int> vertices, const Point& petiole,
                  int nth, std::uint64_t seed, std::optional<double> mm_per_pixel,
                  const std::optional<std::filesystem::path>& mask, std::optional<double> threshold) {
  ReadOptions options = read_options(vertices, petiole, nth, seed);
  options.mm_per_pixel = mm_per_pixel;
  options.mask = mask.value_or("");
  options.threshold = threshold;
  Shared leaf = read(path, options);
  if (!leaf->leaf.photo)
    throw Error(ErrorCode::input,
                fmt::format("'{}' is no photo; take Leaf.from_file", path.filename().string()));
  return leaf;
}

// The rows of an array of `columns` columns.
template <class Matrix, class Array>
Matrix matrix_of(const Array& array, int columns, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != columns) {
    std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    throw Error(ErrorCode::input, fmt::format("{} must be an array of N x {}, not of {}", name, columns,
                                              fmt::join(shape, " x ")));
  }
  using Scalar = typename Array::value_type;
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> rows(array.data(), array.shape(0), columns);
  return rows.template cast<typename Matrix::Scalar>();
}

void require_small(const Whole& faces) {
  const std::int64_t* const end = faces.data() + faces.size();
  const std::int64_t* const large = std::find_if(faces.data(), end, [](std::int64_t index) {
    return index < std::numeric_limits<int>::min() || index > std::numeric_limits<int>::max();
  });
  if (large != end)
    throw Error(ErrorCode::input, fmt::format("a face has vertex {}, which there is not", *large));
}

Shared from_arrays(const Numbers& positions, const Whole& faces, const std::optional<Numbers>& uv,
                   std::optional<int> petiole, std::optional<int> vertices, const std::string& name,
                   std::uint64_t seed) {
  MeshArrays mesh;
  mesh.positions = matrix_of<Points3>(positions, 3, "positions");
  require_small(faces);
  mesh.faces = matrix_of<Faces>(faces, 3, "faces");
  if (uv) mesh.uv = matrix_of<Points2>(*uv, 2, "uv");
  mesh.petiole = petiole;
  ReadOptions options;
  options.vertices = vertices;
  options.seed = seed;
  return made(vertices,
              [&](const Monitor& monitor) { return leaf_from_arrays(mesh, name, options, monitor); });
}

// The constructors.
void bind_sources(py::class_<LeafObject, Shared>& leaf) {
  namespace o = docs::ReadOptions;
  namespace a = docs::MeshArrays;
  const py::kw_only kw;
  const auto none = py::none();
  leaf.def_static("from_species", from_species, py::arg("name"), py::arg("vertices") = none,
                  py::arg("seed") = 1, docs::make_leaf);
  leaf.def_static("from_file", from_file, py::arg("path"), kw, py::arg("vertices") = none,
                  py::arg("petiole") = none, py::arg("nth") = 1, py::arg("seed") = 1, py::arg("scan") = false,
                  py::arg("mm_per_unit") = none,
                  with_arguments(docs::read_leaf, {{"vertices", o::vertices},
                                                   {"petiole", o::petiole},
                                                   {"nth", o::nth},
                                                   {"scan", o::scan},
                                                   {"mm_per_unit", o::mm_per_unit}})
                      .c_str());
  leaf.def_static("from_photo", from_photo, py::arg("path"), kw, py::arg("vertices") = none,
                  py::arg("petiole") = none, py::arg("nth") = 1, py::arg("seed") = 1,
                  py::arg("mm_per_pixel") = none, py::arg("mask") = none, py::arg("threshold") = none,
                  with_arguments(docs::read_leaf, {{"vertices", o::vertices},
                                                   {"petiole", o::petiole},
                                                   {"nth", o::nth},
                                                   {"mm_per_pixel", o::mm_per_pixel},
                                                   {"mask", o::mask},
                                                   {"threshold", o::threshold}})
                      .c_str());
  leaf.def_static("from_arrays", from_arrays, py::arg("positions"), py::arg("faces"), py::arg("uv") = none,
                  py::arg("petiole") = none, kw, py::arg("vertices") = none, py::arg("name") = "arrays",
                  py::arg("seed") = 1,
                  with_arguments(docs::leaf_from_arrays, {{"positions", a::positions},
                                                          {"faces", a::faces},
                                                          {"uv", a::uv},
                                                          {"petiole", a::petiole},
                                                          {"vertices", o::vertices}})
                      .c_str());
}

void bind_arrays(py::class_<LeafObject, Shared>& leaf) {
  namespace d = docs::Leaf;
  const auto array = [&leaf](const char* name, auto values, const char* doc) {
    leaf.def_property_readonly(
        name,
        [values](const Shared& self) {
          const py::object owner = owner_of(self);
          return view(values(self->leaf), owner);
        },
        doc);
  };
  array(
      "positions", [](const Leaf& l) -> const Points3& { return l.positions; }, d::positions);
  array(
      "faces", [](const Leaf& l) -> const Faces& { return l.mesh.face_matrix(); },
      docs::SurfaceMesh::face_matrix);
  array(
      "uv", [](const Leaf& l) -> const Points2& { return l.skin.uv; }, docs::Skin::uv);
  array(
      "uv_faces", [](const Leaf& l) -> const Faces& { return l.skin.faces; }, docs::Skin::faces);
  array(
      "stalk", [](const Leaf& l) -> const Points3& { return l.stalk.centreline; }, docs::Stalk::centreline);
  leaf.def_property_readonly(
      "stalk_radii",
      [](const Shared& self) {
        const py::object owner = owner_of(self);
        const std::vector<double>& radii = self->leaf.stalk.radii;
        return view(radii.data(), {static_cast<py::ssize_t>(radii.size())}, owner);
      },
      docs::Stalk::radii);
  leaf.def_property_readonly(
      "uv_vertices", [](const LeafObject& self) { return indices(self.leaf.skin.vertex); },
      docs::Skin::vertex);
  leaf.def_property_readonly(
      "boundary",
      [](const LeafObject& self) { return indices(margin_loop(self.leaf.mesh, self.leaf.positions)); },
      docs::margin_loop);
  leaf.def_property_readonly(
      "boundary_loops",
      [](const LeafObject& self) {
        std::vector<py::array_t<int>> loops;
        for (const auto& loop : self.leaf.mesh.boundary_loops()) loops.push_back(indices(loop));
        return loops;
      },
      docs::SurfaceMesh::boundary_loops);
  leaf.def_property_readonly(
      "normals",
      [](const LeafObject& self) { return owned(vertex_normals(self.leaf.mesh, self.leaf.positions)); },
      docs::vertex_normals);
}

}  // namespace

void bind_leaf(py::module_& m) {
  namespace d = docs::Leaf;
  py::class_<LeafObject, Shared> leaf(m, "Leaf", d::self);
  bind_sources(leaf);
  bind_arrays(leaf);
  leaf.def_property_readonly(
      "name", [](const LeafObject& self) { return self.leaf.name; }, d::name);
  leaf.def_property_readonly(
      "species", [](const LeafObject& self) { return self.leaf.species; }, d::species);
  leaf.def_property_readonly(
      "seed", [](const LeafObject& self) { return self.leaf.seed; }, "What varies the individual.");
  leaf.def_property_readonly(
      "notes", [](const LeafObject& self) { return self.leaf.notes; }, d::notes);
  leaf.def_property_readonly(
      "petiole", [](const LeafObject& self) { return static_cast<int>(self.leaf.petiole); }, d::petiole);
  leaf.def_property_readonly(
      "length", [](const LeafObject& self) { return leaf_length(self.leaf); }, docs::leaf_length);
  leaf.def("__repr__", [](const LeafObject& self) {
    return fmt::format("<wilt.Leaf {}: {} vertices, {:.0f} mm>", self.leaf.name,
                       self.leaf.mesh.num_vertices(), 1e3 * leaf_length(self.leaf));
  });
}

}  // namespace wilt::python
