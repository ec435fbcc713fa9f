// The elements of a drawing, whoever parsed its XML. Inside the import room only.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace wilt::svg {

struct Element {
  int depth = 0;     ///< 0: the root
  std::string name;  ///< as it stands there, a prefix too
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;     ///< of a style sheet; of others it says nothing
  std::size_t end = 0;  ///< one behind the place of its last descendant
};

/// In the order of the document: the first is the root, and descendants follow their element.
using Elements = std::vector<Element>;

/// Sets Element::end from the depths. O(#elements).
void set_ends(Elements& elements);

/// "" when the element does not have it.
const std::string& attribute(const Element& element, const std::string& name);

/// The element's name without the prefix "svg:".
std::string local_name(const Element& element);

}  // namespace wilt::svg
