// wilt.Result: what a run leaves behind.
#include "result.hpp"

#include <fmt/format.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "errors.hpp"
#include "wilt/core/error.hpp"
#include "wilt/core/file.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/output/report.hpp"
#include "wilt/run/result_files.hpp"
#include "wilt/run/result_formats.hpp"

namespace wilt::python {
namespace {

using Shared = std::shared_ptr<ResultObject>;

FileOptions file_options(const SaveOptions& options) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorCode::configuration, what); };
  if (options.max_morphs != 0 && (options.max_morphs < 2 || options.max_morphs > 100000))
    refuse(fmt::format("max_morphs {} must be 0 (all frames) or 2 to 100000", options.max_morphs));
  if (options.lods < 0 || options.lods > 8) refuse(fmt::format("lods {} must be 0 to 8", options.lods));
  if (options.vat != "exr" && options.vat != "png")
    refuse(
        fmt::format("vat '{}' must be exr or png{}", options.vat, did_you_mean(options.vat, {"exr", "png"})));
  return {options.max_morphs, options.lods, options.vat == "png"};
}

int frame_count(const ResultObject& result) {
  return static_cast<int>(result.withered->result.frames.size());
}

}  // namespace

void save(const ResultObject& result, const std::vector<std::filesystem::path>& paths,
          const SaveOptions& options) {
  const FileOptions files = file_options(options);
  std::vector<std::string> names;
  for (const std::filesystem::path& path : paths) names.push_back(path.string());
  check_results(names, {}, frame_count(result));
  computing([&](const Monitor& monitor) {
    ResultFiles writer(*result.withered, monitor, files);
    for (const std::string& name : names) {
      monitor.throw_if_cancelled();
      writer.write(name);
    }
  });
}

Image picture(const ResultObject& result, int frame, int width, int height) {
  const int count = frame_count(result), which = frame < 0 ? count + frame : frame;
  if (which < 0 || which >= count)
    throw Error(ErrorCode::configuration,
                fmt::format("frame {} must be {} to {}; -1 is the last", frame, -count, count - 1));
  for (const int side : {width, height}) {
    if (side < 1 || side > 16384)
      throw Error(ErrorCode::configuration,
                  fmt::format("a picture of {} x {} pixels; 1 to 16384 are allowed", width, height));
  }
  Image image;
  computing([&](const Monitor& monitor) {
    image = ResultFiles(*result.withered, monitor).picture(which, width, height);
  });
  return image;
}

namespace {

py::array_t<std::uint8_t> pixels(const ResultObject& result, int frame, int width, int height) {
  auto* image = new Image(picture(result, frame, width, height));
  const py::capsule owner(image, [](void* held) { delete static_cast<Image*>(held); });
  return py::array_t<std::uint8_t>(std::vector<py::ssize_t>{image->height, image->width, 3},
                                   image->rgb.data(), owner);
}

py::dict metrics_table(const ResultObject& self) {
  using M = FrameMetrics;
  const std::vector<M>& rows = self.withered->result.metrics;
  py::dict table;
  table["iteration"] = column(rows, &M::iteration);
  table["wrinkle"] = column(rows, &M::wrinkle);
  table["curl"] = column(rows, &M::curl);
  table["area_ratio"] = column(rows, &M::area_ratio);
  table["projected_area_ratio"] = column(rows, &M::projected_area_ratio);
  table["max_strain"] = column(rows, &M::max_strain);
  table["self_intersections"] = column(rows, &M::self_intersections);
  return table;
}

py::dict steps_table(const ResultObject& self) {
  using S = StepRow;
  const std::vector<S>& rows = self.withered->result.steps;
  py::dict table;
  table["iteration"] = column(rows, &S::iteration);
  table["dt"] = column(rows, &S::dt);
  table["newton"] = column(rows, &S::newton);
  table["linear"] = column(rows, &S::linear);
  table["residual"] = column(rows, &S::residual);
  table["converged"] = column(rows, &S::converged);
  table["kinetic"] = column(rows, &S::kinetic);
  table["elastic"] = column(rows, &S::elastic);
  table["bending"] = column(rows, &S::bending);
  table["water"] = column(rows, &S::water);
  return table;
}

py::dict forces_table(const ResultObject& self) {
  using F = ForceRow;
  const std::vector<F>& rows = self.withered->result.forces;
  py::list regions;
  for (const F& row : rows) regions.append(region_name(row.region));
  py::dict table;
  table["iteration"] = column(rows, &F::iteration);
  table["region"] = py::module_::import("numpy").attr("array")(regions);
  table["elastic"] = column(rows, &F::elastic);
  table["damping"] = column(rows, &F::damping);
  table["swelling"] = column(rows, &F::swelling);
  table["external"] = column(rows, &F::external);
  table["water"] = column(rows, &F::water);
  table["pressure"] = column(rows, &F::pressure);
  return table;
}

std::vector<std::shared_ptr<FrameObject>> frames_of(const ResultObject& self) {
  const SimulationResult& result = self.withered->result;
  std::vector<std::shared_ptr<FrameObject>> list;
  for (std::size_t k = 0; k < result.frames.size(); ++k)
    list.push_back(std::make_shared<FrameObject>(
        FrameObject{self.subject, {self.withered, &result.frames[k]}, result.metrics[k]}));
  return list;
}

}  // namespace

void bind_result(py::module_& m) {
  namespace d = docs::SimulationResult;
  py::class_<ResultObject, Shared> result(m, "Result", "What a run leaves behind; it never changes.");
  const auto fact = [&result](const char* name, auto member, const char* doc) {
    result.def_property_readonly(
        name, [member](const ResultObject& self) { return self.withered->result.*member; }, doc);
  };
  fact("completed", &SimulationResult::completed, d::completed);
  fact("stop_reason", &SimulationResult::stop_reason, d::stop_reason);
  fact("note", &SimulationResult::note, d::note);
  fact("positions_hash", &SimulationResult::positions_hash, d::positions_hash);
  result.def_property_readonly("frames", frames_of, d::frames);
  result.def_property_readonly("metrics", metrics_table, docs::FrameMetrics::self);
  result.def_property_readonly("steps", steps_table, docs::StepRow::self);
  result.def_property_readonly("forces", forces_table, docs::ForceRow::self);
  result.def_property_readonly(
      "report", [](const ResultObject& self) -> py::dict { return from_json(report_of(*self.withered)); },
      docs::report_json);
  result.def(
      "save",
      [](const ResultObject& self, const py::args& paths, int max_morphs, int lods, const std::string& vat) {
        std::vector<std::filesystem::path> names;
        for (const py::handle path : paths) names.push_back(path_of(path));
        save(self, names, {max_morphs, lods, vat});
      },
      py::kw_only(), py::arg("max_morphs") = 0, py::arg("lods") = 0, py::arg("vat") = "exr",
      with_arguments(docs::save, {{"max_morphs", docs::SaveOptions::max_morphs},
                                  {"lods", docs::SaveOptions::lods},
                                  {"vat", docs::SaveOptions::vat}})
          .c_str());
  result.def("picture", pixels, py::arg("frame") = -1, py::arg("width") = 960, py::arg("height") = 720,
             docs::picture);
  result.def("__repr__", [](const ResultObject& self) {
    const SimulationResult& r = self.withered->result;
    return fmt::format("<wilt.Result of {}: {} frames to iteration {}{}>", self.withered->leaf.name,
                       r.frames.size(), r.frames.back().iteration, r.completed ? "" : ", not completed");
  });
}

}  // namespace wilt::python
