// The species and the settings that are built in.
#include <nlohmann/json.hpp>

#include "bindings.hpp"
#include "docs.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt::python {
namespace {

py::dict all_species() {
  py::dict all;
  for (const std::string& name : species_names()) all[name.c_str()] = species(name);
  return all;
}

py::object fresh_value(const Setting& setting, const nlohmann::json& values) {
  return from_json(values.at(setting.key).dump());
}

py::dict all_settings(const std::string& species_name) {
  const nlohmann::json values = nlohmann::json::parse(to_json(default_config(species(species_name))));
  py::dict all;
  for (const Setting& setting : settings()) {
    py::dict row;
    row["default"] = fresh_value(setting, values);
    row["unit"] = setting.unit;
    row["help"] = setting.help;
    if (setting.has_range()) row["range"] = py::make_tuple(setting.min, setting.max);
    if (!setting.words.empty()) row["words"] = setting.words;
    row["during_run"] = setting.during_run;
    all[setting.key.c_str()] = row;
  }
  return all;
}

}  // namespace

void bind_species(py::module_& m) {
  namespace d = docs::Species;
  namespace p = docs::Physiology;
  const auto physiology = [](double Physiology::*member) {
    return [member](const Species& s) { return s.physiology.*member; };
  };
  py::class_<Species>(m, "Species", "One of the species that are built in.")
      .def_readonly("name", &Species::name, d::name)
      .def_readonly("botanical", &Species::botanical, d::botanical)
      .def_readonly("common", &Species::common, d::common)
      .def_readonly("length", &Species::length, d::length)
      .def_readonly("stalk_length", &Species::stalk_length, d::stalk_length)
      .def_readonly("stalk_radius", &Species::stalk_radius, d::stalk_radius)
      .def_property_readonly("mass_min", physiology(&Physiology::mass_min), p::mass_min)
      .def_property_readonly("mass_max", physiology(&Physiology::mass_max), p::mass_max)
      .def_property_readonly("leaf_parameter", physiology(&Physiology::leaf_parameter), p::leaf_parameter)
      .def_property_readonly("dehydration_rate", physiology(&Physiology::dehydration_rate),
                             p::dehydration_rate)
      .def_property_readonly("force_range", physiology(&Physiology::force_range), p::force_range)
      .def_property_readonly("dryness_scale", physiology(&Physiology::dryness_scale), p::dryness_scale)
      .def_property_readonly("shrinkage", physiology(&Physiology::shrinkage), p::shrinkage)
      .def("__repr__", [](const Species& s) { return "<wilt.Species " + s.name + ": " + s.common + ">"; });
  m.def("species", all_species, "{name: Species} of what is built in, in the order of the paper's Table 1.");
  m.def("settings", all_settings, py::arg("species") = "generic",
        "{key: {default, unit, help, range or words, during_run}} of every setting of a simulation, with a "
        "species' "
        "defaults.");
}

}  // namespace wilt::python
