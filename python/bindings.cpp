#include "bindings.hpp"

#include <algorithm>

namespace wilt::python {
namespace {

// As `--set` takes it; bool before numbers, as Python's are numbers too.
std::string text_of(const py::handle& value) {
  if (py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value)) {
    std::string list;
    for (const py::handle entry : value) list += (list.empty() ? "" : ",") + text_of(entry);
    return list;
  }
  std::string text = py::str(value);
  if (py::isinstance<py::bool_>(value) || text == "True" || text == "False")
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string dotted(std::string key) {
  for (std::size_t at = key.find("__"); at != std::string::npos; at = key.find("__")) key.replace(at, 2, ".");
  return key;
}

}  // namespace

std::vector<Assignment> assignments_of(const py::dict& keywords, const std::string& prefix) {
  std::vector<Assignment> list;
  for (const auto& [key, value] : keywords) list.push_back({prefix + dotted(py::str(key)), text_of(value)});
  return list;
}

py::object from_json(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

std::string with_arguments(const char* text,
                           std::initializer_list<std::pair<const char*, const char*>> arguments) {
  std::string all = text;
  all += "\n";
  for (const auto& [name, meaning] : arguments) all += std::string("\n") + name + ": " + meaning;
  return all;
}

}  // namespace wilt::python
