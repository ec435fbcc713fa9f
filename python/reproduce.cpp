// wilt.reproduce, and what else stands alone.
#include "wilt/reproduce/reproduce.hpp"

#include <filesystem>
#include <memory>

#include "bindings.hpp"
#include "computing.hpp"
#include "docs.hpp"
#include "wilt/core/parallel.hpp"
#include "wilt/core/version.hpp"
#include "wilt/import/read_leaf.hpp"

namespace wilt::python {
namespace {

py::list run(const std::vector<std::string>& figures, const std::filesystem::path& directory, int vertices,
             std::pair<int, int> size, int samples, std::uint64_t seed) {
  ReproduceOptions options;
  options.vertices = vertices;
  options.pictures = {size.first, size.second, samples, seed};
  std::string claims;
  computing([&](const Monitor& monitor) {
    claims = claims_json(reproduce(chosen_figures(figures), directory.string(), options, monitor));
  });
  return from_json(claims);
}

// While its block lasts.
class Threads {
 public:
  explicit Threads(int most) : most_(most) {}
  void enter() { limit_ = std::make_unique<ThreadLimit>(most_); }
  void leave() { limit_.reset(); }

 private:
  int most_;
  std::unique_ptr<ThreadLimit> limit_;
};

}  // namespace

void bind_reproduce(py::module_& m) {
  namespace p = docs::PictureSettings;
  const PictureSettings pictures;
  m.def("reproduce", run, py::arg("figures"), py::arg("directory"), py::kw_only(),
        py::arg("vertices") = ReproduceOptions().vertices,
        py::arg("size") = std::pair(pictures.width, pictures.height), py::arg("samples") = pictures.samples,
        py::arg("seed") = pictures.seed,
        with_arguments(docs::reproduce, {{"figures", docs::chosen_figures},
                                         {"vertices", docs::ReproduceOptions::vertices},
                                         {"size", p::width},
                                         {"samples", p::samples},
                                         {"seed", docs::ReproduceOptions::pictures}})
            .c_str());
  py::class_<Threads>(m, "threads", docs::ThreadLimit::self)
      .def(py::init<int>(), py::arg("most"))
      .def("__enter__", [](Threads& threads) { threads.enter(); })
      .def("__exit__", [](Threads& threads, const py::args&) { threads.leave(); });
  m.def(
      "count_leaves",
      [](const std::filesystem::path& path) {
        int count = 0;
        computing([&](const Monitor&) { count = count_leaves(path); });
        return count;
      },
      py::arg("path"), docs::count_leaves);
  m.attr("__version__") = version();
}

}  // namespace wilt::python
