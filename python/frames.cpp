// wilt.Frame, wilt.State and wilt.FrameMetrics: a leaf at one iteration.
#include "frames.hpp"

#include <fmt/format.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "wilt/mesh/geometry.hpp"
#include "wilt/output/clip.hpp"

namespace wilt::python {

Points3 colours_of(const FrameObject& frame) {
  Config untextured = frame.subject->config;
  untextured.texture.size = 0;
  const std::vector<Frame> frames{*frame.frame};
  return make_clip(frame.subject->leaf->leaf, frame.subject->veins->venation, untextured, frames)
      .colours.front();
}

namespace {

using SharedFrame = std::shared_ptr<FrameObject>;
using SharedState = std::shared_ptr<StateObject>;

void bind_metrics(py::module_& m) {
  using M = FrameMetrics;
  namespace d = docs::FrameMetrics;
  py::class_<M>(m, "FrameMetrics", d::self)
      .def_readonly("iteration", &M::iteration, docs::Frame::iteration)
      .def_readonly("wrinkle", &M::wrinkle, d::wrinkle)
      .def_readonly("curl", &M::curl, d::curl)
      .def_readonly("area_ratio", &M::area_ratio, d::area_ratio)
      .def_readonly("projected_area_ratio", &M::projected_area_ratio, d::projected_area_ratio)
      .def_readonly("max_strain", &M::max_strain, d::max_strain)
      .def_readonly("self_intersections", &M::self_intersections, d::self_intersections)
      .def("__repr__", [](const M& metrics) {
        return fmt::format("<wilt.FrameMetrics {}: wrinkle {:.4f}, curl {:.3f} rad, area {:.3f}>",
                           metrics.iteration, metrics.wrinkle, metrics.curl, metrics.area_ratio);
      });
}

py::class_<FrameObject, SharedFrame> bind_frame(py::module_& m) {
  namespace d = docs::Frame;
  py::class_<FrameObject, SharedFrame> frame(m, "Frame", d::self);
  const auto array = [&frame](const char* name, auto member, const char* doc) {
    frame.def_property_readonly(
        name,
        [member](const SharedFrame& self) {
          const py::object owner = owner_of(self);
          return view((*self->frame).*member, owner);
        },
        doc);
  };
  array("positions", &Frame::positions, d::positions);
  array("stalk", &Frame::stalk, d::stalk);
  array("water_fraction", &Frame::water_fraction, d::water_fraction);
  array("dryness", &Frame::dryness, d::dryness);
  frame.def_property_readonly(
      "iteration", [](const FrameObject& self) { return self.frame->iteration; }, d::iteration);
  frame.def_readonly("metrics", &FrameObject::metrics, docs::FrameMetrics::self);
  frame.def_property_readonly(
      "normals",
      [](const FrameObject& self) {
        return owned(vertex_normals(self.subject->leaf->leaf.mesh, self.frame->positions));
      },
      docs::vertex_normals);
  frame.def_property_readonly(
      "colours",
      [](const FrameObject& self) {
        Points3 colours;
        computing([&](const Monitor&) { colours = colours_of(self); });
        return owned(std::move(colours));
      },
      docs::colours_of);
  frame.def("__repr__", [](const py::object& self) {
    return fmt::format("<wilt.{} {}>", std::string(py::str(py::type::of(self).attr("__name__"))),
                       self.cast<const FrameObject&>().frame->iteration);
  });
  return frame;
}

void bind_state(py::module_& m, const py::class_<FrameObject, SharedFrame>& frame) {
  namespace d = docs::StateObject;
  py::class_<StateObject, SharedState> state(m, "State", frame, d::self);
  const auto array = [&state](const char* name, auto member, const char* doc) {
    state.def_property_readonly(
        name,
        [member](const SharedState& self) {
          const py::object owner = owner_of(self);
          return view((*self).*member, owner);
        },
        doc);
  };
  array("working_positions", &StateObject::working_positions, d::working_positions);
  array("velocities", &StateObject::velocities, d::velocities);
  array("water", &StateObject::water, d::water);
  array("dry_mass", &StateObject::dry_mass, d::dry_mass);
  array("mass", &StateObject::mass, d::mass);
  array("pressure", &StateObject::pressure, d::pressure);
  state.def_property_readonly(
      "forces",
      [](const SharedState& self) {
        const py::object owner = owner_of(self);
        const ForceBreakdown& forces = self->forces;
        py::dict by_kind;
        by_kind["elastic"] = view(forces.elastic, owner);
        by_kind["damping"] = view(forces.damping, owner);
        by_kind["swelling"] = view(forces.swelling, owner);
        by_kind["external"] = view(forces.external, owner);
        return by_kind;
      },
      d::forces);
}

}  // namespace

void bind_frames(py::module_& m) {
  bind_metrics(m);
  bind_state(m, bind_frame(m));
}

}  // namespace wilt::python
