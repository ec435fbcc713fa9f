#include "wilt/import/svg_element.hpp"

namespace wilt::svg {

void set_ends(Elements& elements) {
  for (std::size_t i = elements.size(); i-- > 0;) {
    std::size_t end = i + 1;  // behind the element itself, then behind each child
    while (end < elements.size() && elements[end].depth > elements[i].depth) end = elements[end].end;
    elements[i].end = end;
  }
}

const std::string& attribute(const Element& element, const std::string& name) {
  static const std::string none;
  for (const auto& [key, value] : element.attributes)
    if (key == name) return value;
  return none;
}

std::string local_name(const Element& element) {
  return element.name.rfind("svg:", 0) == 0 ? element.name.substr(4) : element.name;
}

}  // namespace wilt::svg
