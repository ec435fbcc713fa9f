// wilt.Venation and wilt.Vein: what leaf.veins() finds.
#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "arrays.hpp"
#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "objects.hpp"
#include "veins.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/geodesics/surface_path.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/output/veins_files.hpp"
#include "wilt/run/leaf_request.hpp"

namespace wilt::python {

std::shared_ptr<VeinsObject> find_veins(const std::shared_ptr<const LeafObject>& leaf, const Config& config,
                                        const std::string& file) {
  auto veins = std::make_shared<VeinsObject>(VeinsObject{leaf, {}, config});
  LeafRequest request;
  request.veins = file;
  computing([&](const Monitor& monitor) {
    veins->venation =
        load_veins(request, leaf->leaf, species(config.species).secondary, venation_options(config), monitor);
  });
  return veins;
}

Points3 path_positions(const VeinObject& self) {
  const Leaf& leaf = self.veins->leaf->leaf;
  const auto& path = self.vein->path.points;
  Points3 points(static_cast<int>(path.size()), 3);
  for (std::size_t i = 0; i < path.size(); ++i)
    points.row(static_cast<int>(i)) = position(leaf.mesh, leaf.positions, path[i]).transpose();
  return points;
}

void save_veins(const VeinsObject& veins, const std::filesystem::path& path) {
  const VeinsWriter text = veins_writer(path.string());
  computing([&](const Monitor&) { write_file(path.string(), text(veins.leaf->leaf, veins.venation)); });
}

namespace {

using Shared = std::shared_ptr<VeinsObject>;

Shared veins_of(const std::shared_ptr<LeafObject>& leaf, const std::optional<std::filesystem::path>& file,
                const py::kwargs& options) {
  Config config = default_config(species(leaf->leaf.species));
  for (const Assignment& one : assignments_of(options, "veins.")) set(config, one.key, one.value);
  if (!file) return find_veins(leaf, config, "");
  Shared veins;
  reading(*file, [&] { veins = find_veins(leaf, config, file->string()); });
  return veins;
}

void bind_vein(py::module_& m) {
  namespace d = docs::Vein;
  py::class_<VeinObject>(m, "Vein", "A vein on the blade at rest.")
      .def_property_readonly(
          "order", [](const VeinObject& v) { return v.vein->order; }, d::order)
      .def_property_readonly(
          "tip", [](const VeinObject& v) { return v.vein->tip; }, d::tip)
      .def_property_readonly(
          "parent", [](const VeinObject& v) { return v.vein->parent; }, d::parent)
      .def_property_readonly(
          "length", [](const VeinObject& v) { return v.vein->path.length; }, docs::SurfacePath::length)
      .def_property_readonly(
          "positions", [](const VeinObject& v) { return owned(path_positions(v)); }, docs::path_positions);
}

void bind_tips(py::class_<VeinsObject, Shared>& veins) {
  namespace d = docs::Tip;
  veins.def_property_readonly(
      "tips",
      [](const VeinsObject& self) {
        std::vector<VertexId> vertices;
        for (const Tip& tip : self.venation.tips) vertices.push_back(tip.vertex);
        return indices(vertices);
      },
      docs::Venation::tips);
  const auto tip_column = [](double Tip::*member) {
    return [member](const VeinsObject& self) { return column(self.venation.tips, member); };
  };
  veins.def_property_readonly("tip_s", tip_column(&Tip::s), d::s);
  veins.def_property_readonly("tip_d", tip_column(&Tip::d), d::d);
  veins.def_property_readonly("tip_prominence", tip_column(&Tip::prominence), d::prominence);
}

void bind_fields(py::class_<VeinsObject, Shared>& veins) {
  namespace d = docs::Venation;
  namespace p = docs::MarginProfile;
  const auto array = [&veins](const char* name, auto values, const char* doc) {
    veins.def_property_readonly(
        name,
        [values](const Shared& self) {
          const py::object owner = owner_of(self);
          return view(values(self->venation), owner);
        },
        doc);
  };
  array(
      "s", [](const Venation& v) -> const Eigen::VectorXd& { return v.margin.s; }, p::s);
  array(
      "d", [](const Venation& v) -> const Eigen::VectorXd& { return v.margin.d; }, p::d);
  array(
      "flat", [](const Venation& v) -> const Points2& { return v.flat; }, d::flat);
  array(
      "primary_distance", [](const Venation& v) -> const Eigen::VectorXd& { return v.primary_distance; },
      d::primary_distance);
  array(
      "vein_distance", [](const Venation& v) -> const Eigen::VectorXd& { return v.vein_distance; },
      d::vein_distance);
  veins.def_property_readonly(
      "margin", [](const VeinsObject& self) { return indices(self.venation.margin.vertices); }, p::vertices);
}

}  // namespace

void bind_veins(py::module_& m) {
  namespace d = docs::Venation;
  bind_vein(m);
  py::class_<VeinsObject, Shared> veins(m, "Venation", docs::Venation::self);
  bind_tips(veins);
  bind_fields(veins);
  veins.def_property_readonly(
      "veins",
      [](const Shared& self) {
        owner_of(self);
        std::vector<VeinObject> list;
        for (const Vein& vein : self->venation.veins) list.push_back({self, &vein});
        return list;
      },
      d::veins);
  veins.def_property_readonly(
      "from_photo", [](const VeinsObject& self) { return self.venation.from_photo; }, d::from_photo);
  veins.def("save", save_veins, py::arg("path"), docs::save_veins);
  veins.def("__repr__", [](const VeinsObject& self) {
    return fmt::format("<wilt.Venation of {}: {} tips, {} veins>", self.leaf->leaf.name,
                       self.venation.tips.size(), self.venation.veins.size());
  });
  const py::object leaf = m.attr("Leaf");
  leaf.attr("veins") = py::cpp_function(veins_of, py::name("veins"), py::is_method(leaf), py::kw_only(),
                                        py::arg("file") = py::none(), docs::find_veins);
}

}  // namespace wilt::python
